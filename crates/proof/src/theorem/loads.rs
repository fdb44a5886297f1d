//! Theorems on loads of any direction, and on gravity that leans.

use cannonpile::each::Each;
use cannonpile::geometry::{Load, Vector};
use cannonpile::lattice::{Direction, Sign};
use cannonpile::theorem::setting::{
    P, Setting, above, above_floor, by_component, by_line, cross, equations, half, int,
    nothing_left, sum_over_base, sum_over_pile, symbol, transmitted,
};
use cannonpile::theorem::{Formulas, ProofKind, Step};
use num_traits::{One, Zero};

use super::terms::{SIGNS, Theorem};

pub(super) const THEOREMS: &[Theorem] = &[
    Theorem {
        name: "load",
        statement: "A load of any direction: a sphere with the load (w, X, Y) receives any forces g and transmits g \
                     plus its load increments. It is in equilibrium for every φ and under steps of either sign. On an \
                     equilateral base it is also in equilibrium at a sign change, where it transmits Gg plus its \
                     increments for the sign below. A disc with the load (w, X, 0) is in equilibrium in the same way. \
                     Here the load is W(X, Y, w) in the unit f₀ and the basis of the directions, with W = 2(1+s), and \
                     2(X, 0, w) for discs. A vertical load n adds n times the increments (6). The load (w, −X, −Y) \
                     adds under − what (w, X, Y) adds under +; an identity",
        hypotheses: "0 < s < 1, at sign changes s = 1/2; any g_1, g_2, g_3, n, w, X, Y",
        method: ProofKind::Identity,
        symbols: "s, n, w, X, Y, g_1, g_2, g_3",
        derive: |f| load(&f.core),
    },
    Theorem {
        name: "tilt",
        statement: "Gravity that leans by (x, y): every sphere has the load (1, x, y). Every sphere of the paper's \
                     pile is in equilibrium if N spheres on a line transmit NΔ, where Δ is the load increment of the \
                     line. Let |t|² = x² + 4(1−s²)y²; the tangent of the tilt is (in words) |t| tanθ. Let t* = ((1−s)/2, \
                     ±1/4), D = (1−s)/2 and λ = 1−s for α and β, and t* = (−s, 0), D = s² and λ = s for γ. For discs \
                     let t* = (±1, 0), D = 1 and λ = 2. Then Δ = 0 at t*, and |t|² − D + λΔ = |t − t*|². So (in words) \
                     |t*|² = D, and Δ > 0 if |t|² < D: t* is the least tilt at which Δ = 0. A straight pile under \
                     any top, of any height, has (in words, by theorem run) the forces NΔ with N ≥ 1, so it bears \
                     exactly the tilts with all Δ ≥ 0, which a single sphere bears. On an equilateral base D = 1/4 for \
                     all three lines, so the least tilt that opens a contact is |t| = 1/2; an identity",
        hypotheses: "0 < s < 1, weights of mg, + steps",
        method: ProofKind::Identity,
        symbols: "i, j, k, n, s, x, y",
        derive: |f| tilt(&f.core),
    },
    Theorem {
        name: "tilt-total",
        statement: "Total force and moment under gravity that leans by (x, y): in the paper's pile, the forces on the \
                     floor sum to L(L+1)(L+2)/6 times W(x, y, 1). About each axis through the apex, they have the \
                     moment of the loads of all spheres, ΣF × r_b = Σ W(x, y, 1) × r_s; for every φ; by summing over \
                     base and pile",
        hypotheses: "L ≥ 1, 0 < s < 1",
        method: ProofKind::Sum,
        symbols: "L, s, x, y",
        derive: |f| tilt_total(&f.core),
    },
];

/// Returns the horizontal part of a load on a sphere of weight `weight`, in the unit and the basis of the forces.
fn horizontal(load: &Load<P>, weight: &P) -> Vector<P> {
    Vector {
        x: weight.clone() * &load.x,
        y: weight.clone() * &load.y,
        z: P::zero(),
    }
}

fn vertical(down: P) -> Load<P> {
    down.into()
}

/// Returns the load of a sphere under gravity that leans by (x, y), both symbols.
fn leaning() -> Load<P> {
    Load::leaning(P::one(), &["x", "y"].each(symbol))
}

/// Returns the setting with the increments of spheres under gravity that leans. Its forces from above are then those
/// of the straight pile, and the horizontal part of the load must be added to its resultants.
fn leaned(f: &Formulas) -> Setting {
    let setting = Setting::isosceles(f);
    Setting {
        increments: (f.load_increments)(&leaning(), &setting.s, Sign::Plus),
        ..setting
    }
}

fn load(f: &Formulas) -> Vec<Step> {
    let [g1, g2, g3] = ["g_1", "g_2", "g_3"].each(symbol);
    let [down, x, y] = ["w", "X", "Y"].each(symbol);
    let load = Load { down, x, y };
    let mirrored = Load {
        x: -load.x.clone(),
        y: -load.y.clone(),
        ..load.clone()
    };
    // The sum of all forces on a sphere with this load.
    let left = |to_below: &[P; 3], below: &_, g: &[P; 3], over: &_, load: &Load<P>, weight: &P| {
        let down = load.down.clone() * weight;
        (f.unbalanced)(to_below, below, g, over, &down) + &horizontal(load, weight)
    };
    let (spheres, equilateral) = (Setting::isosceles(f), Setting::equilateral(f));
    let discs = Setting::discs(f);
    let of_sphere = |load: &Load<P>, s: &P, sign| (f.load_increments)(load, s, sign);
    let on_disc = Load {
        y: P::zero(),
        ..load.clone()
    };
    let (received, on_plane) = ([g1.clone(), g2.clone(), g3], [g1, g2, P::zero()]);
    let mut steps = Vec::new();
    for (name, sign) in SIGNS {
        let under = |setting: &Setting| match sign {
            Sign::Plus => (setting.directions.clone(), setting.turned_directions(f)),
            Sign::Minus => (setting.turned_directions(f), setting.directions.clone()),
        };
        let (e, _) = under(&spheres);
        let own = of_sphere(&load, &spheres.s, sign);
        let to_below = transmitted(f, received.clone(), &own);
        let sum = left(&to_below, &e, &received, &e, &load, &spheres.weight);
        steps.extend(nothing_left(
            &format!("under {name}, the resultant is 0"),
            sum,
        ));

        let (below, over) = under(&equilateral);
        let own = of_sphere(&load, &equilateral.s, sign);
        let to_below = transmitted(f, (f.half_turn)(&received), &own);
        let sum = left(
            &to_below,
            &below,
            &received,
            &over,
            &load,
            &equilateral.weight,
        );
        let claim = format!("at a sign change to {name}, the resultant is 0");
        steps.extend(nothing_left(&claim, sum));

        let (e, _) = under(&discs);
        let own = (f.disc_load_increments)(&on_disc, sign);
        let to_below = transmitted(f, on_plane.clone(), &own);
        let sum = left(&to_below, &e, &on_plane, &e, &on_disc, &discs.weight);
        let claim = format!("disc under {name}, the resultant is 0");
        steps.extend(nothing_left(&claim, sum));

        let n = symbol("n");
        let weighs = vertical(n.clone());
        let claim = format!("vertical load under {name}: n increments");
        let own = of_sphere(&weighs, &spheres.s, sign);
        steps.extend(by_line(&claim, own, spheres.loaded(f, &n).0));
        let claim = format!("vertical load of a disc under {name}: n increments");
        let own = (f.disc_load_increments)(&weighs, sign);
        steps.extend(by_line(&claim, own, discs.loaded(f, &n).0));
    }
    let [plus, minus] = [(&load, Sign::Plus), (&mirrored, Sign::Minus)]
        .each(|(load, sign)| of_sphere(load, &spheres.s, sign));
    steps.extend(by_line(
        "(w, −X, −Y) under − as (w, X, Y) under +",
        minus,
        plus,
    ));
    let [plus, minus] = [(&load, Sign::Plus), (&mirrored, Sign::Minus)]
        .each(|(load, sign)| (f.disc_load_increments)(load, sign));
    steps.extend(by_line(
        "disc: (w, −X, −Y) under − as (w, X, Y) under +",
        minus,
        plus,
    ));
    steps
}

/// The nearest tilt t* at which the increment of a line is 0, the square D of its length, and the factor λ.
struct Nearest {
    line: Direction,
    tilt: [P; 2],
    square: P,
    factor: P,
}

impl Nearest {
    /// Returns the steps for these increments, as a function of the load, with the squared length of a tilt.
    fn steps(
        self,
        of: &str,
        increments: &impl Fn(&Load<P>) -> [P; 3],
        squared: &impl Fn(&[P; 2]) -> P,
    ) -> Vec<Step> {
        let Self {
            line,
            tilt: [x, y],
            square,
            factor,
        } = self;
        let at = |tilt: &[P; 2]| {
            let increments = increments(&Load::leaning(P::one(), tilt));
            increments[line.index()].clone()
        };
        let any = ["x", "y"].each(symbol);
        let apart = [any[0].clone() - &x, any[1].clone() - &y];
        equations! {
            (format!("{of}, {line}: Δ = 0 at t*")): at(&[x, y]) => P::zero(),
            (format!("{of}, {line}: |t|² − D + λΔ = |t − t*|²")):
                squared(&any) - &square + &(factor * &at(&any)) => squared(&apart),
        }
    }
}

fn tilt(f: &Formulas) -> Vec<Step> {
    let (setting, counts) = (leaned(f), above(f));
    let left = setting.unbalanced(f, &counts) + &horizontal(&leaning(), &setting.weight);
    let mut steps = nothing_left("the resultant is 0 under a tilt", left);
    let n = [(); 3].each(|()| symbol("n"));
    let more = n.clone().each(|n| n + &P::one());
    let none = [(); 3].each(|()| P::zero());
    let received = |counts: &[P; 3]| setting.received(f, counts);
    let after = setting.to_below(f, received(&n));
    steps.extend(by_line("no sphere, no force", received(&none), none));
    steps.extend(by_line("nΔ + Δ = (n+1)Δ", after, received(&more)));

    let s = &setting.s;
    let less = (P::one() - s) * &half();
    let fourth = half() * &half();
    let slanted = |line, y| Nearest {
        line,
        tilt: [less.clone(), y],
        square: less.clone(),
        factor: P::one() - s,
    };
    let ahead = Nearest {
        line: Direction::Gamma,
        tilt: [-s.clone(), P::zero()],
        square: s.clone() * s,
        factor: s.clone(),
    };
    let of_sphere = |load: &Load<P>| (f.load_increments)(load, s, Sign::Plus);
    let squared = |[x, y]: &[P; 2]| {
        setting.horizontal_square(&Vector {
            x: x.clone(),
            y: y.clone(),
            z: P::zero(),
        })
    };
    for nearest in [
        slanted(Direction::Alpha, fourth.clone()),
        slanted(Direction::Beta, -fourth),
        ahead,
    ] {
        steps.extend(nearest.steps("spheres", &of_sphere, &squared));
    }
    // A disc tilts in its plane only.
    let of_disc = |load: &Load<P>| (f.disc_load_increments)(load, Sign::Plus);
    let squared = |[x, _]: &[P; 2]| x.clone() * x;
    for (line, x) in [(Direction::Alpha, int(1)), (Direction::Beta, int(-1))] {
        let nearest = Nearest {
            line,
            tilt: [x, P::zero()],
            square: int(1),
            factor: int(2),
        };
        steps.extend(nearest.steps("discs", &of_disc, &squared));
    }
    steps
}

fn tilt_total(f: &Formulas) -> Vec<Step> {
    let setting = leaned(f);
    let floor = above_floor(f);
    let force = setting.support_load(f, &floor) + &horizontal(&leaning(), &setting.weight);
    let load = horizontal(&leaning(), &setting.weight)
        + &Vector {
            x: P::zero(),
            y: P::zero(),
            z: setting.weight.clone(),
        };
    let spheres = (f.spheres)(&symbol("L"), 3);
    let total = force.clone().map(|part| sum_over_base(&part));
    let loads = load.clone().map(|part| part * &spheres);
    let mut steps = by_component("ΣF = spheres·W(x, y, 1)", total, loads);
    let place = |counts: &[P; 3]| (f.position)(counts, &setting.directions);
    let on_floor = cross(&force, &place(&floor)).map(|part| sum_over_base(&part));
    let of_loads = cross(&load, &place(&above(f))).map(|part| sum_over_pile(&part));
    steps.extend(by_component(
        "ΣF × r_b = ΣW(x, y, 1) × r_s",
        on_floor,
        of_loads,
    ));
    steps
}
