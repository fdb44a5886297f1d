"""Answers that have several parts: tuples with names, whose types are in the stub beside this file."""

from collections import namedtuple


class Multiples(namedtuple("Multiples", "numerators denominator")):
    """All contact forces as exact multiples of f0.

    The force of contact m is ``numerators[m] / denominator``.

    Attributes
    ----------
    numerators : numpy.ndarray of int64 or list of int
        An int64 array of shape (M,) where all numerators fit, else a list of M ints.
    denominator : int
        What they are all over.

    Examples
    --------
    >>> from cannonpile import Pile
    >>> numerators, denominator = Pile(3, "hcp").multiples()
    >>> numerators[:6], denominator
    (array([3, 3, 3, 2, 5, 5]), 3)
    """

    __slots__ = ()


class Contact(namedtuple("Contact", "k i j direction force")):
    """A sloping contact of the sphere (k, i, j) with one below it, and its force in f0.

    Attributes
    ----------
    k : int
    i : int
    j : int
    direction : str
    force : Fraction

    Examples
    --------
    >>> from cannonpile import Pile
    >>> Pile(4, "hcp", top="hexagon:3").weakest()
    Contact(k=2, i=1, j=-3, direction='gamma', force=Fraction(2, 9))
    """

    __slots__ = ()


class FloorForce(namedtuple("FloorForce", "normal shear_x shear_y")):
    """The force of a bottom sphere on the floor, exact.

    Attributes
    ----------
    normal : Fraction
        In mg.
    shear_x : Fraction
        In mg tan theta.
    shear_y : Fraction
        In 2 cos phi mg tan theta: sqrt(3) mg tan theta on an equilateral base.

    Examples
    --------
    >>> from cannonpile import Pile
    >>> Pile(10).on_floor(0, 0)
    FloorForce(normal=Fraction(4, 1), shear_x=Fraction(-3, 2), shear_y=Fraction(-3, 2))
    """

    __slots__ = ()


class Bounds(namedtuple("Bounds", "least greatest proved")):
    """What a bottom sphere bears at least and at most at a = R, horizontal contacts included.

    Attributes
    ----------
    least : Fraction
        In mg.
    greatest : Fraction
        In mg.
    proved : bool
        Whether some forces attain both; if not, no forces pass them, and how close they come is not known.

    Examples
    --------
    >>> from cannonpile import Pile
    >>> Pile(4).bounds(3, 0)
    Bounds(least=Fraction(2, 1), greatest=Fraction(10, 3), proved=True)
    """

    __slots__ = ()


class Theorem(namedtuple("Theorem", "name statement hypotheses symbols method holds")):
    """A statement about every pile, and whether its proof holds.

    Attributes
    ----------
    name : str
    statement : str
        What is proved, in words and formulas.
    hypotheses : str
        For which values of the symbols it is meant.
    symbols : str
        The symbols in it.
    method : str
        How it is proved: identity, sum, induction, ....
    holds : bool
        Whether both sides of every step are the same.

    Examples
    --------
    >>> from cannonpile import prove
    >>> all(theorem.holds for theorem in prove())
    True
    """

    __slots__ = ()


class CensusEntry(namedtuple("CensusEntry", "stacking layers stands least_force normal_min normal_max")):
    """A stacking, and whether it stands.

    Attributes
    ----------
    stacking : str
        Its steps, from the top; from the base up where it was grown from a base.
    layers : int
    stands : bool
    least_force : Fraction or None
        The least contact force in f0, without horizontal contacts; None of a single layer.
    normal_min : Fraction or None
        The least normal force on the floor in mg; None of a pile that does not stand without horizontal contacts.
    normal_max : Fraction or None
        The greatest one.

    Examples
    --------
    >>> from cannonpile import census
    >>> [entry.stacking for entry in census(4, standing=True)]
    ['+++', '+--', '+-+', '++-']
    """

    __slots__ = ()


class MeanForce(namedtuple("MeanForce", "a b probability normal shear_x shear_y")):
    """What a place of the floor bears in the mean over random stackings.

    The place is a u_beta + b u_gamma from that of the sphere (0, 0) of the top layer, or of the base where the piles are grown
    from one; u_beta and u_gamma are the horizontal parts of the contacts beta and gamma below a + step.

    Attributes
    ----------
    a : int
    b : int
    probability : Fraction
        That a sphere is there.
    normal : Fraction
        In mg; a stacking without a sphere there counts as 0.
    shear_x : Fraction
        In mg tan theta.
    shear_y : Fraction
        In sqrt(3) mg tan theta.

    Examples
    --------
    >>> from cannonpile import mean
    >>> mean(3)[0].probability, mean(3)[0].normal
    (Fraction(1, 2), Fraction(5, 6))
    """

    __slots__ = ()


class Known(namedtuple("Known", "title purpose stands")):
    """What is known of a benchmark case.

    Attributes
    ----------
    title : str
        What the pile is, in a few words.
    purpose : str
        What the case tests in a code of contact forces.
    stands : bool or None
        Whether the pile stands; None of spheres without weight, of which it is not asked.

    Examples
    --------
    >>> from cannonpile import cases
    >>> cases()[7].known.stands
    False
    """

    __slots__ = ()


class Case(namedtuple("Case", "name pile known")):
    """A benchmark case: a name that others can quote, its pile, and what is known of it.

    Attributes
    ----------
    name : str
    pile : Pile
    known : Known

    Examples
    --------
    >>> from cannonpile import cases
    >>> name, pile, known = cases()[10]
    >>> name, pile
    ('C11', Pile(stacking='+-+-+', spacing=1, state='elastic'))
    """

    __slots__ = ()


class Difference(namedtuple("Difference", "ids k i j direction exact measured error text")):
    """A contact of a pile, its exact force, and what was measured.

    Attributes
    ----------
    ids : tuple[int, int]
        The numbers of the upper sphere and of the lower one.
    k : int
    i : int
    j : int
    direction : str
    exact : float
        The nearest float to the exact force, in N; positive is push.
    measured : float or None
        The measured one; None of a contact that was not measured.
    error : float
        The relative error; 1 of a contact that was not measured.
    text : str
        All of it in words.

    Examples
    --------
    >>> from cannonpile import Pile
    >>> difference = Pile(2).compare([[1, 2], [1, 3], [1, 4]], [0.4622, 0.4622, 0.5]).worst
    >>> difference.ids, difference.direction, difference.measured
    ((1, 4), 'gamma', 0.5)
    """

    __slots__ = ()
