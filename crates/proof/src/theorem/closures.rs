//! Theorems on the stress of a sphere: relations among its components that need no law of deformation.
//!
//! The stress times the volume is R Σ f ê⊗ê over the contacts of a sphere, with z up. It is linear in the forces, so a
//! relation that holds for three forces along the three lines holds for all contacts above a sphere, and for all below.

use cannonpile::each::Each;
use cannonpile::geometry::{Load, Vector};
use cannonpile::lattice::{Direction, Sign};
use cannonpile::theorem::setting::{P, Setting, by_line, equations, int, symbol, transmitted};
use cannonpile::theorem::{Formulas, ProofKind, Step};
use num_traits::{One, Zero};

use super::steps::{complex, dot, steps_down};
use super::terms::{SIGNS, Theorem, sum, symbols, transferred};

pub(super) const THEOREMS: &[Theorem] = &[
    Theorem {
        name: "primary-closure",
        statement: "The primary closure: all contacts make the angle θ with the vertical. So any forces f along the \
                     three lines of a sphere, under steps of either sign, have Σf(ê_x² + ê_y²) = tan²θ Σf ê_z², and \
                     discs have Σf ê_x² = tan²θ Σf ê_z². So (in words, by adding the contacts above and below) the \
                     stress of every sphere satisfies σ_xx + σ_yy = tan²θ σ_zz, and that of every disc σ_xx = tan²θ \
                     σ_zz: in every stacking, for every φ, and under all loads and tilts. Contacts with the floor are \
                     left out. A compressive horizontal contact adds to the left side alone; an identity",
        hypotheses: "0 < s < 1; any forces; no horizontal contacts",
        method: ProofKind::Identity,
        symbols: "s, g_1, g_2, g_3",
        derive: |f| primary(&f.core),
    },
    Theorem {
        name: "secondary-closure",
        statement: "The secondary closure: let τ be +1 under + and −1 under −, and let z point up. Forces along the \
                     three lines of a sphere under steps of one sign satisfy σ_xy = τ s tanθ σ_yz and σ_xx = s tan²θ \
                     σ_zz − τ(1−s) tanθ σ_xz. So (in words) every sphere of a straight pile does, and on an \
                     equilateral base 2σ_xy = τ tanθ σ_yz and σ_xx − σ_yy = −τ tanθ σ_xz. At a sign change on an \
                     equilateral base a sphere of any weight that receives g transmits Gg plus its increments. It \
                     satisfies σ_xx = σ_yy and σ_xy = 0, because the parts of the contacts above and below cancel. So \
                     (in words) every sphere without a horizontal load satisfies the closure of a straight pile with τ \
                     the mean of the signs above and below; an identity",
        hypotheses: "0 < s < 1, at sign changes s = 1/2 and no horizontal load; any forces; no horizontal contacts",
        method: ProofKind::Identity,
        symbols: "s, n, g_1, g_2, g_3",
        derive: |f| secondary(&f.core),
    },
    Theorem {
        name: "mean-closure",
        statement: "The closure of random stackings: at the fault probability 1/2 the next sign is + or − with equal \
                     probability, whatever the spheres above. A sphere transmits f under +, and Gf under −: a load of \
                     any direction also has increments under − that are G times those under +. The mean of both is \
                     isotropic: σ_xx = σ_yy and σ_xy = 0. So (in words) with theorem primary-closure the mean stress \
                     of the contacts below each place is σ_xx = σ_yy = ½tan²θ σ_zz, σ_xy = 0. For the contacts above, \
                     let u be the horizontal step of a line, V₁ and h₁ the mean load and horizontal force at the place \
                     −u from the lower sphere, and V₂ and h₂ at the place +u. The mean force of the contact along this \
                     line from above is (V₁+V₂)/6 + u·(h₁−h₂)/3, in units of ρ. So (in words) it deviates from that of \
                     an isotropic stress by second differences of V and first differences of h, which vanish for long \
                     waves. In this limit the balance of forces makes σ_zz a wave with the speed tanθ/√2, as in \
                     theorem mean-spectrum; an identity",
        hypotheses: "s = 1/2, q = 1/2; any forces and loads; no horizontal contacts",
        method: ProofKind::Identity,
        symbols: "g_1, g_2, g_3, h_1, h_2, h_3, w, X, Y",
        derive: |f| mean(&f.core),
    },
];

/// Returns Σ f·of(ê) over three contacts.
fn total(forces: &[P; 3], along: &[Vector<P>; 3], of: impl Fn(&Vector<P>) -> P) -> P {
    sum(forces.iter().zip(along).map(|(f, e)| of(e) * f))
}

/// Returns the directions of the contacts under steps of one sign.
fn directions(f: &Formulas, setting: &Setting, sign: Sign) -> [Vector<P>; 3] {
    match sign {
        Sign::Plus => setting.directions.clone(),
        Sign::Minus => setting.turned_directions(f),
    }
}

fn xx(e: &Vector<P>) -> P {
    e.x.clone() * &e.x
}

fn xy(e: &Vector<P>) -> P {
    e.x.clone() * &e.y
}

fn zz(e: &Vector<P>) -> P {
    e.z.clone() * &e.z
}

/// Returns ê_x² − ê_y² over sin²θ on an equilateral base, where y has the unit √3 sinθ.
fn difference(e: &Vector<P>) -> P {
    xx(e) - &(int(3) * &e.y * &e.y)
}

fn primary(f: &Formulas) -> Vec<Step> {
    let [a, b, c] = symbols(["g_1", "g_2", "g_3"]);
    // Discs lie in the plane y = 0, and have no third line.
    let settings = [
        ("", Setting::isosceles(f), [a.clone(), b.clone(), c]),
        ("discs ", Setting::discs(f), [a, b, P::zero()]),
    ];
    let cases = settings.iter().flat_map(|of| SIGNS.map(|sign| (of, sign)));
    let steps = cases.map(|((what, setting, g), (name, sign))| {
        let e = directions(f, setting, sign);
        Step::equal(
            format!("{what}under {name}: xx + yy = zz"),
            total(g, &e, |e| setting.horizontal_square(e)),
            total(g, &e, zz),
        )
    });
    steps.collect()
}

fn secondary(f: &Formulas) -> Vec<Step> {
    let (any, equilateral) = (Setting::isosceles(f), Setting::equilateral(f));
    let g = symbols(["g_1", "g_2", "g_3"]);
    let (own, _) = equilateral.loaded(f, &symbol("n"));
    let below = transmitted(f, (f.half_turn)(&g), &own);
    let mut steps = Vec::new();
    for (name, sign) in SIGNS {
        let e = directions(f, &any, sign);
        let sigma = int(sign.factor().into());
        // The vectors point down, and xz and yz change their signs if z points up.
        let [xz, yz] = [
            total(&g, &e, |e| -(e.x.clone() * &e.z)),
            total(&g, &e, |e| -(e.y.clone() * &e.z)),
        ];
        let across = (P::one() - &any.s) * &sigma * &xz;
        let [above, under] = [sign, -sign].each(|sign| directions(f, &equilateral, sign));
        let both = |of: fn(&Vector<P>) -> P| total(&g, &above, of) + &total(&below, &under, of);
        steps.extend(equations! {
            (format!("under {name}: xy = τs yz")): total(&g, &e, xy) => sigma * &any.s * &yz,
            (format!("under {name}: xx = s zz − τ(1−s) xz")):
                total(&g, &e, xx) => any.s.clone() * &total(&g, &e, zz) - &across,
            (format!("at a sign change below {name}: xx = yy")): both(difference) => P::zero(),
            (format!("at a sign change below {name}: xy = 0")): both(xy) => P::zero(),
        });
    }
    steps
}

fn mean(f: &Formulas) -> Vec<Step> {
    let setting = Setting::equilateral(f);
    let [g, k] = [
        symbols(["g_1", "g_2", "g_3"]),
        symbols(["h_1", "h_2", "h_3"]),
    ];
    let [down, x, y] = ["w", "X", "Y"].each(symbol);
    let load = Load { down, x, y };
    let [plus, minus] = [Sign::Plus, Sign::Minus].each(|sign| directions(f, &setting, sign));
    let both = |of: fn(&Vector<P>) -> P| {
        total(&g, &plus, of) + &total(&transferred(f, true, &g), &minus, of)
    };
    let mut steps = equations! {
        "below, the sum under both signs: xx = yy": both(difference) => P::zero(),
        "below, the sum under both signs: xy = 0": both(xy) => P::zero(),
    };
    let own = |sign| (f.load_increments)(&load, &setting.s, sign);
    steps.extend(by_line(
        "the increments of a load under −: G times those under +",
        own(Sign::Minus),
        transferred(f, true, &own(Sign::Plus)),
    ));
    let [down, _] = steps_down(f);
    let horizontal = |forces: &[P; 3]| {
        let parts = forces.iter().zip(&down);
        parts.fold(complex(P::zero(), P::zero()), |h, (force, u)| {
            h + &complex(u.x.clone() * force, u.y.clone() * force)
        })
    };
    let apart = horizontal(&g) - &horizontal(&k);
    let loads = sum(g.clone()) + &sum(k.clone());
    let turned = transferred(f, true, &k);
    for line in Direction::ALL {
        let l = line.index();
        steps.push(Step::equal(
            format!("above, along {line}: six times the mean force"),
            (g[l].clone() + &turned[l]) * &int(3),
            loads.clone() + &(int(2) * &dot(&down[l], &apart)),
        ));
    }
    steps
}
