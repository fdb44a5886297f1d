//! Theorems on two layers on a rough floor, without glue.

use cannonpile::each::Each;
use cannonpile::geometry::Vector;
use cannonpile::theorem::setting::{
    P, Setting, by_component, cross, equations, half, int, nothing_left, symbol,
};
use cannonpile::theorem::{Formulas, ProofKind, Step};
use num_traits::{One, Zero};

use super::terms::Theorem;

pub(super) const THEOREMS: &[Theorem] = &[
    Theorem {
        name: "rough-contact",
        statement: "A contact on a rough floor: let t = tan(θ/2), so cosθ = (1−t²)/(1+t²) and sinθ = 2t/(1+t²). Let N \
                     act along the contact, and T = Nt across it, in its vertical plane. N and T are at right angles. \
                     The vertical part of their sum is N, and the horizontal part is T, on the lower sphere away from \
                     the upper one. The sum has no moment about the point where the lower sphere touches the floor, so \
                     (in words) contacts superpose. This holds for every φ and for discs. All steps are multiplied by \
                     1+t², or by its square; an identity",
        hypotheses: "0 < s < 1, 0 < t < 1",
        method: ProofKind::Identity,
        symbols: "s, t, N",
        derive: |f| contact(&f.core),
    },
    Theorem {
        name: "rough-floor",
        statement: "Two layers on a rough floor, without glue: let f be the numbers of the contacts without friction, \
                     and let each contact transmit N = f·mg/W along its line and T = N·tan(θ/2) across it. An upper \
                     sphere of weight n·mg, loads included, is in equilibrium, in force and moment. A lower sphere \
                     receives any numbers g and has the weight n·mg. The load on its supports without friction, with \
                     tan(θ/2) instead of tanθ, is its force on the floor: its forces and moments are in equilibrium. \
                     This holds for every φ and θ, under steps of either sign, and for discs; an identity",
        hypotheses: "0 < s < 1, 0 < t < 1 for t = tan(θ/2); any vertical loads n, any g_1, g_2, g_3",
        method: ProofKind::Identity,
        symbols: "s, t, n, g_1, g_2, g_3",
        derive: |f| rough_floor(&f.core),
    },
    Theorem {
        name: "rough-unique",
        statement: "Uniqueness on a rough floor: let a, b, c be the sides from ê_a to ê_b, from ê_b to ê_c and from \
                     ê_c to ê_a. Their triangle has an area, so (in words) forces without loads are horizontal at an \
                     upper sphere, with one λ for each two contacts. On a lower sphere let λ_1 a − λ_2 c act at ê_a, \
                     λ_3 b − λ_4 a at ê_b and λ_5 c − λ_6 b at ê_c. They sum to (λ_1−λ_4)a + (λ_3−λ_6)b + (λ_5−λ_2)c. \
                     The floor point takes no moment, so (in words) this is 0 and the three differences are one κ. The \
                     moment about the vertical axis is then −(1+s)κ, so κ = 0. So (in words) λ is the same on opposite \
                     sides, along whole lines, and 0 at the end of a finite layer: there is one set of forces; an \
                     identity",
        hypotheses: "0 < s < 1, any finite upper layer",
        method: ProofKind::Identity,
        symbols: "s, κ, λ_1, λ_2, λ_3, λ_4, λ_5, λ_6",
        derive: |f| unique(&f.core),
    },
];

/// The angle θ by t = tan(θ/2). All values are multiplied by 1 + t².
struct HalfAngle {
    tan: P,
    one: P,
    sin: P,
    cos: P,
}

impl HalfAngle {
    fn new() -> Self {
        let tan = symbol("t");
        let square = tan.clone() * &tan;
        Self {
            one: P::one() + &square,
            sin: tan.clone() + &tan,
            cos: P::one() - &square,
            tan,
        }
    }

    /// Returns a vector in units of R, 2cosφ·R, R instead of those of the directions.
    fn in_units_of_radius(&self, v: Vector<P>) -> Vector<P> {
        let [x, y, z] = v.on(&[self.sin.clone(), self.sin.clone(), self.cos.clone()]);
        Vector { x, y, z }
    }

    /// Returns the unit vector across a contact on the upper sphere, for its direction `e` up.
    fn across(&self, e: Vector<P>) -> Vector<P> {
        let [x, y, z] = e.on(&[-self.cos.clone(), -self.cos.clone(), self.sin.clone()]);
        Vector { x, y, z }
    }

    /// Returns the force on the upper sphere of a contact with direction `e` up: N along it and T = Nt across it.
    fn on_upper(&self, normal: &P, e: &Vector<P>) -> Vector<P> {
        let across = self.across(e.clone()).scaled(&self.tan);
        (self.in_units_of_radius(e.clone()) + &across).scaled(normal)
    }

    /// Returns the force of a lower sphere on the floor, from the load on its supports without friction.
    fn on_floor(&self, load: Vector<P>) -> Vector<P> {
        let [x, y, z] = load.on(&[self.tan.clone(), self.tan.clone(), P::one()]);
        Vector { x, y, z }.scaled(&self.one)
    }

    /// Returns the position of a contact as seen from the upper sphere: half the position of the lower one, which is in
    /// units of 2R.
    fn lever_of_upper(&self, f: &Formulas, line: usize, e: &[Vector<P>; 3]) -> Vector<P> {
        let count = [0, 1, 2].each(|n| int(i128::from(n == line)));
        self.in_units_of_radius((f.position)(&count, e))
    }

    /// Returns the position of a contact as seen from the point where the lower sphere touches the floor.
    fn lever_about_floor(&self, f: &Formulas, line: usize, e: &[Vector<P>; 3]) -> Vector<P> {
        let down = Vector {
            z: self.one.clone(),
            ..Vector::zero()
        };
        -(self.lever_of_upper(f, line, e) + &down)
    }
}

/// A contact: its name, the directions, its index, and the expected horizontal part of its direction.
type Contact = (&'static str, [Vector<P>; 3], usize, [P; 2]);

/// Returns the contacts of spheres and of discs.
fn contacts(f: &Formulas) -> Vec<Contact> {
    let (spheres, discs) = (
        Setting::isosceles(f).directions,
        Setting::discs(f).directions,
    );
    let s = symbol("s");
    Vec::from([
        ("α", spheres.clone(), 0, [s.clone(), half()]),
        ("β", spheres.clone(), 1, [s, -half()]),
        ("γ", spheres, 2, [int(-1), int(0)]),
        ("α of discs", discs.clone(), 0, [int(1), int(0)]),
        ("β of discs", discs, 1, [int(-1), int(0)]),
    ])
}

fn contact(f: &Formulas) -> Vec<Step> {
    let (angle, setting, normal) = (HalfAngle::new(), Setting::isosceles(f), symbol("N"));
    let mut steps = Vec::new();
    for (name, e, line, [x, y]) in contacts(f) {
        let along = angle.in_units_of_radius(e[line].clone());
        let across = angle.across(e[line].clone());
        let [sum, apart] = [along.clone() + &across, along - &across];
        let square = |v: &Vector<P>| setting.horizontal_square(v) + &(v.z.clone() * &v.z);
        steps.extend(equations! {
            (format!("{name}: N and T are at right angles")): square(&sum) => square(&apart),
        });
        let force = angle.on_upper(&normal, &e[line]);
        let tangential = normal.clone() * &angle.tan;
        let expected = Vector {
            x: tangential.clone() * &x,
            y: tangential * &y,
            z: -normal.clone(),
        };
        let claim = format!("{name}: their sum is (T h, −N)");
        steps.extend(by_component(
            &claim,
            force.clone(),
            expected.scaled(&angle.one),
        ));
        let moment = cross(&angle.lever_about_floor(f, line, &e), &-force);
        let claim = format!("{name}: no moment about the floor point");
        steps.extend(nothing_left(&claim, moment));
    }
    steps
}

fn rough_floor(f: &Formulas) -> Vec<Step> {
    let angle = HalfAngle::new();
    let [g1, g2, g3] = ["g_1", "g_2", "g_3"].each(symbol);
    let on_plane = [g1.clone(), g2.clone(), P::zero()];
    let (spheres, discs) = (Setting::isosceles(f), Setting::discs(f));
    let mut steps = Vec::new();
    for (shape, setting, g) in [("sphere", spheres, [g1, g2, g3]), ("disc", discs, on_plane)] {
        for (sign, e) in [
            ("+", setting.directions.clone()),
            ("−", setting.turned_directions(f)),
        ] {
            let (own, weight) = setting.loaded(f, &symbol("n"));
            let down = Vector {
                z: weight.clone() * &angle.one,
                ..Vector::zero()
            };
            let (mut sum, mut moment) = (down.clone(), Vector::zero());
            for (line, number) in own.iter().enumerate() {
                let force = angle.on_upper(number, &e[line]);
                moment = moment + &cross(&angle.lever_of_upper(f, line, &e), &force);
                sum = sum + &force;
            }
            let claim = format!("upper {shape} under {sign}");
            steps.extend(nothing_left(&format!("{claim}: no resultant"), sum));
            steps.extend(nothing_left(&format!("{claim}: no moment"), moment));

            let on_floor = angle.on_floor((f.support_load)(&g, &e, &weight));
            let (mut sum, mut moment) = (down - &on_floor, Vector::zero());
            for (line, number) in g.iter().enumerate() {
                let force = -angle.on_upper(number, &e[line]);
                moment = moment + &cross(&angle.lever_about_floor(f, line, &e), &force);
                sum = sum + &force;
            }
            let claim = format!("lower {shape} under {sign}");
            steps.extend(nothing_left(&format!("{claim}: no resultant"), sum));
            steps.extend(nothing_left(
                &format!("{claim}: no moment about the floor point"),
                moment,
            ));
        }
    }
    steps
}

fn unique(f: &Formulas) -> Vec<Step> {
    let setting = Setting::isosceles(f);
    let (s, [e_a, e_b, e_c]) = (&setting.s, &setting.directions);
    let [a, b, c] = [(e_a, e_b), (e_b, e_c), (e_c, e_a)].each(|(from, to)| to.clone() - from);
    let turn = |v: &Vector<P>, w: &Vector<P>| cross(v, w).z;
    // The sum and the moment of the forces at the three contacts.
    let balance = |[l1, l2, l3, l4, l5, l6]: &[P; 6]| {
        let combined =
            |v: &Vector<P>, l: &P, w: &Vector<P>, m: &P| v.clone().scaled(l) - &w.clone().scaled(m);
        let forces = [
            combined(&a, l1, &c, l2),
            combined(&b, l3, &a, l4),
            combined(&c, l5, &b, l6),
        ];
        let moments = setting.directions.iter().zip(&forces);
        let moment = moments.fold(P::zero(), |sum, (e, force)| sum + &turn(e, force));
        (
            forces.iter().fold(Vector::zero(), |sum, force| sum + force),
            moment,
        )
    };
    let all @ [l1, l2, l3, l4, l5, l6] = &["λ_1", "λ_2", "λ_3", "λ_4", "λ_5", "λ_6"].map(symbol);
    let [on_a, on_b, on_c] = [(l1, l4), (l3, l6), (l5, l2)].each(|(l, m)| l.clone() - m);
    let (sum, moment) = balance(all);
    let wide = P::one() + s;
    let along_x = wide.clone() * &(on_c.clone() - &on_b);
    let along_y = on_b.clone() + &on_c - &(int(2) * &on_a);
    let turning = int(2) * s * &on_a + &on_b + &on_c;
    let kappa = symbol("κ");
    let [with_1, with_3, with_5] = [l4, l6, l2].each(|l| l.clone() + &kappa);
    let one_kappa = [with_1, l2.clone(), with_3, l4.clone(), with_5, l6.clone()];
    let (_, about_axis) = balance(&one_kappa);
    equations! {
        "twice the area of the triangle is −(1+s)": turn(&a, &b) => -wide.clone(),
        "x: the sum is (λ_1−λ_4)a + (λ_3−λ_6)b + (λ_5−λ_2)c": sum.x => along_x,
        "y: twice the sum": sum.y * &int(2) => along_y,
        "twice the moment about the vertical axis": moment * &int(2) => -turning,
        "one κ: the moment is −(1+s)κ": about_axis => -(wide * &kappa),
    }
}
