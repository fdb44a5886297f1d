"""Results with several parts, as named tuples. The stub file declares their types."""

from collections import namedtuple


class Multiples(namedtuple("Multiples", "numerators denominator")):
    """All contact forces as exact multiples of f0.

    The force of contact m is ``numerators[m] / denominator``.

    Attributes
    ----------
    numerators : numpy.ndarray of int64 or list of int
        An int64 array of shape (M,), or a list of M ints if some numerators exceed int64.
    denominator : int
        The common denominator.

    Examples
    --------
    >>> from cannonpile import Pile
    >>> numerators, denominator = Pile(3, "hcp").multiples()
    >>> numerators[:6], denominator
    (array([3, 3, 3, 2, 5, 5]), 3)
    """

    __slots__ = ()


class Contact(namedtuple("Contact", "k i j direction force")):
    """A sloping contact of the sphere (k, i, j) with a sphere below it, and its force in f0.

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
    """The force of a bottom sphere on the floor, exact. On a rough floor theta/2 replaces theta.

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


class RoughContact(namedtuple("RoughContact", "ids k i j direction normal tangential normal_vector tangential_vector")):
    """A contact with friction, of the sphere (k, i, j) with a sphere below it. The vectors are forces on the upper sphere.

    Attributes
    ----------
    ids : tuple[int, int]
        The ids of the upper and the lower sphere.
    k : int
    i : int
    j : int
    direction : str
    normal : Fraction
        The normal force in mg. Compression is positive.
    tangential : Fraction
        The tangential force in mg tan(theta/2). The number is the same.
    normal_vector : tuple[float, float, float]
        The normal force in N, z up, correctly rounded.
    tangential_vector : tuple[float, float, float]
        The tangential force in N, z up, correctly rounded.

    Examples
    --------
    >>> from cannonpile import Pile
    >>> Pile(2, dimension=2).on_rough_floor().contacts()[1].normal_vector
    (-0.3, 0.0, 0.4)
    """

    __slots__ = ()


class Stability(namedtuple("Stability", "margin_squared opens corners")):
    """The tilts of gravity that a pile bears.

    Attributes
    ----------
    margin_squared : Fraction or None
        The square of the least tan(tilt)/tan(theta) beyond which the pile is unstable, or None if it is unstable upright.
    opens : Contact or None
        The contact that opens there, and its force in f0 under upright gravity. None at a = R, where forces are not unique.
    corners : list of tuple of Fraction
        The corners (x, y) of the polygon of tilts, counterclockwise.

    Examples
    --------
    >>> from cannonpile import Pile
    >>> Pile(10).stability().margin_squared
    Fraction(1, 4)
    """

    __slots__ = ()


class Response(namedtuple("Response", "contacts base")):
    """The forces per unit of a load on one sphere.

    Attributes
    ----------
    contacts : list of tuple of Fraction
        For each sloping contact the forces for a load of 1 mg downwards, 1 mg tan theta along x and 2 cos phi mg tan theta
        along y, in f0.
    base : list of tuple of FloorForce
        For each bottom sphere the forces on the floor for the same loads.

    Examples
    --------
    >>> from cannonpile import Pile
    >>> contacts, base = Pile(3).response(1, 0, 0)
    >>> len(contacts), len(base)
    (12, 6)
    """

    __slots__ = ()


class Spread(namedtuple("Spread", "contact variance bearable_squared")):
    """The contact that opens first if all radii deviate independently with the relative standard deviation r.

    Attributes
    ----------
    contact : Contact
        The contact and its force among equal spheres.
    variance : Fraction
        The variance of this force divided by r squared, in f0 squared.
    bearable_squared : Fraction
        r squared where the force is three standard deviations above zero.

    Examples
    --------
    >>> from cannonpile import Pile
    >>> Pile(2, spacing="6/5").spread().contact.direction
    'alpha'
    """

    __slots__ = ()


class Bounds(namedtuple("Bounds", "least greatest proved")):
    """Bounds of the normal force of a bottom sphere at a = R, over all admissible horizontal forces.

    Attributes
    ----------
    least : Fraction
        The lower bound, in mg.
    greatest : Fraction
        The upper bound, in mg.
    proved : bool
        True if both bounds are attained. Otherwise they are valid, but may not be sharp.

    Examples
    --------
    >>> from cannonpile import Pile
    >>> Pile(4).bounds(3, 0)
    Bounds(least=Fraction(2, 1), greatest=Fraction(10, 3), proved=True)
    """

    __slots__ = ()


class Theorem(namedtuple("Theorem", "name statement hypotheses symbols method holds")):
    """A theorem about all piles, and the result of its proof.

    Attributes
    ----------
    name : str
    statement : str
        The statement, in words and formulas.
    hypotheses : str
        The values of the symbols for which it holds.
    symbols : str
        The symbols of the statement.
    method : str
        The method of proof: identity, sum, induction, ….
    holds : bool
        True if the two sides of every step are equal.

    Examples
    --------
    >>> from cannonpile import prove
    >>> all(theorem.holds for theorem in prove())
    True
    """

    __slots__ = ()


class CensusEntry(namedtuple("CensusEntry", "stacking layers stands least_force normal_min normal_max margin_squared")):
    """A stacking and its stability.

    Attributes
    ----------
    stacking : str
        The steps from the top, or from the base upwards if the pile was built from a base.
    layers : int
    stands : bool
    least_force : Fraction or None
        The smallest contact force in f0, without horizontal contacts. None for a single layer.
    normal_min : Fraction or None
        The smallest normal force on the floor in mg. None for a pile that is unstable without horizontal contacts.
    normal_max : Fraction or None
        The largest normal force on the floor in mg.
    margin_squared : Fraction or None
        The square of the least tan(tilt)/tan(theta) at which a contact opens, without horizontal contacts. None for a pile that
        is unstable without them, and for a single layer.

    Examples
    --------
    >>> from cannonpile import census
    >>> [entry.stacking for entry in census(4, standing=True)]
    ['+++', '+--', '+-+', '++-']
    """

    __slots__ = ()


class MeanForce(namedtuple("MeanForce", "a b probability normal shear_x shear_y")):
    """The mean base force at a position, over random stackings.

    The position is a u_beta + b u_gamma relative to sphere (0, 0) of the top layer, or of the base if the piles are built from
    a base. u_beta and u_gamma are the horizontal parts of the contacts beta and gamma below a + step.

    Attributes
    ----------
    a : int
    b : int
    probability : Fraction
        The probability that a sphere is there.
    normal : Fraction
        The normal force in mg. A stacking without a sphere there counts as 0.
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
    """Known facts about a benchmark case.

    Attributes
    ----------
    title : str
        A short description of the pile.
    purpose : str
        What the case tests in a code that computes contact forces.
    stands : bool or None
        True if the pile is stable. None for weightless spheres.

    Examples
    --------
    >>> from cannonpile import cases
    >>> cases()[7].known.stands
    False
    """

    __slots__ = ()


class Case(namedtuple("Case", "name pile known")):
    """A benchmark case: a citable name, its pile, and known facts about it.

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


class FrictionCase(namedtuple("FrictionCase", "name rough_floor known")):
    """A benchmark case on a rough floor: a citable name, its pile on the floor, and known facts about it.

    Attributes
    ----------
    name : str
    rough_floor : RoughFloor
    known : Known

    Examples
    --------
    >>> from cannonpile import friction_cases
    >>> name, rough_floor, known = friction_cases()[0]
    >>> name, rough_floor.friction, known.title
    ('C17', Fraction(1, 2), 'Four balls on a rough table')
    """

    __slots__ = ()


class Difference(namedtuple("Difference", "ids k i j direction exact measured error text")):
    """A contact of a pile, with its exact and its measured force.

    Attributes
    ----------
    ids : tuple[int, int]
        The ids of the upper and the lower sphere.
    k : int
    i : int
    j : int
    direction : str
    exact : float
        The exact force, correctly rounded, in N. Compression is positive.
    measured : float or None
        The measured force in N. None if the contact was not measured.
    error : float
        The relative error. 1 if the contact was not measured.
    text : str
        A description in words.

    Examples
    --------
    >>> from cannonpile import Pile
    >>> difference = Pile(2).compare([[1, 2], [1, 3], [1, 4]], [0.4622, 0.4622, 0.5]).worst
    >>> difference.ids, difference.direction, difference.measured
    ((1, 4), 'gamma', 0.5)
    """

    __slots__ = ()
