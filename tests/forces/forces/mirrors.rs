//! Symmetric piles have symmetric forces. This covers the mirror image of any pile, and the rotations and reflections of
//! symmetric tops.

use cannonpile::lattice::{Region, Site};
use cannonpile::shape::Selection;
use cannonpile::stacking::Stacking;
use cannonpile::{ContactForce, FloorForce, Forces, Pile};
use num_rational::BigRational;

use cannonpile_testkit::cases::{Bounds, Random, all_signs, repeated, stacking};
use cannonpile_testkit::oracles::balance::ratio;

/// Contacts and bottom spheres in the order of tables.
#[derive(Debug, PartialEq)]
struct Answers {
    contacts: Vec<ContactForce<BigRational>>,
    floor: Vec<FloorForce<BigRational>>,
}

impl Answers {
    fn of(pile: &Pile) -> Self {
        let forces: Forces<BigRational> = pile.forces();
        Self {
            contacts: forces
                .contacts(Selection::All)
                .unwrap()
                .map(Result::unwrap)
                .collect(),
            floor: forces
                .base(Selection::Base)
                .unwrap()
                .map(Result::unwrap)
                .collect(),
        }
    }

    /// Moves every sphere within its layer, together with its contacts. α moves to position `turn[0]` of α, β, γ, and so on.
    fn moved(mut self, to: impl Fn(Site) -> Site, turn: [usize; 3]) -> Self {
        for contact in &mut self.contacts {
            contact.site = to(contact.site);
            contact.direction =
                cannonpile_testkit::oracles::balance::direction(turn[contact.direction.index()]);
        }
        for force in &mut self.floor {
            force.site = to(force.site);
        }
        self.contacts.sort_by_key(|c| (c.site, c.direction));
        self.floor.sort_by_key(|force| force.site);
        self
    }

    fn with_shears(
        mut self,
        change: impl Fn(&BigRational, &BigRational) -> [BigRational; 2],
    ) -> Self {
        for force in &mut self.floor {
            [force.shear_x, force.shear_y] = change(&force.shear_x, &force.shear_y);
        }
        self
    }
}

fn is_mirrored(pile: &Pile, image: &Pile) {
    let mirrored = Answers::of(pile)
        .moved(|Site { i, j, k }| Site { i: -i, j: -j, k }, [0, 1, 2])
        .with_shears(|x, y| [-x, -y]);
    assert_eq!(mirrored, Answers::of(image));
    let [standing, of_image] = [pile, image].map(|pile| pile.standing().unwrap());
    assert_eq!(standing.first_failure, of_image.first_failure);
    let force = |least: Option<ContactForce<BigRational>>| least.map(|least| least.force);
    assert_eq!(force(standing.least), force(of_image.least));
}

#[test]
fn of_piles_under_random_tops() {
    let mut random = Random(51);
    for _ in 0..80 {
        let top: Region = random.bounds(4).region();
        let steps = random.below(9);
        let stacking: Stacking = stacking(&random.signs(steps));
        let image = Pile::under(top.mirrored(), stacking.mirrored()).unwrap();
        is_mirrored(&Pile::under(top, stacking).unwrap(), &image);
    }
}

#[test]
fn of_piles_on_random_bases() {
    let mut random = Random(52);
    let mut compared = 0;
    while compared < 80 {
        let base: Region = random.bounds(10).region();
        let steps = random.below(8);
        let stacking: Stacking = stacking(&random.signs(steps));
        if let Ok(pile) = Pile::on(base, stacking.clone()) {
            is_mirrored(
                &pile,
                &Pile::on(base.mirrored(), stacking.mirrored()).unwrap(),
            );
            compared += 1;
        }
    }
}

/// The rotation by a third about the axis, and the reflection that exchanges β and γ.
///
/// At the corners of a hexagon, i, j and c − i − j have the same bounds, with c = p − q. Each + step moves the axis by one
/// more. The rotation maps α to β, β to γ and γ to α.
fn is_symmetric(pile: &Pile, c: i128) {
    let answers = || Answers::of(pile);
    let signs: Vec<_> = pile.shape().stacking().signs().collect();
    let across = |k: i128| {
        let above = signs.iter().take(usize::try_from(k).unwrap());
        let steps = above.map(|sign| if sign.symbol() == '+' { 1 } else { -1 });
        c + steps.sum::<i128>()
    };
    let rotated = answers().moved(
        |Site { i, j, k }| Site {
            i: across(k) - i - j,
            j: i,
            k,
        },
        [1, 2, 0],
    );
    // (0, 1) becomes (3/2, −1/2), and (3/2, 1/2) becomes (0, −1), in the units of x and of y.
    let [half, three_halves] = [1, 3].map(|n| ratio(n, 2));
    let rotated = rotated.with_shears(|x, y| [y * &three_halves - x * &half, -(x + y) * &half]);
    assert_eq!(rotated, answers());
    let reflected = answers().moved(|Site { i, j, k }| Site { i: j, j: i, k }, [0, 2, 1]);
    // (0, 1) and (3/2, 1/2) are exchanged.
    let reflected = reflected.with_shears(|x, y| [y * &three_halves - x * &half, (x + y) * &half]);
    assert_eq!(reflected, answers());
}

#[test]
fn of_piles_under_one_sphere_about_the_axis() {
    for signs in (0..8).flat_map(all_signs) {
        is_symmetric(&Pile::under(Region::SITE, stacking(&signs)).unwrap(), 0);
    }
}

#[test]
fn of_piles_under_hexagons_and_triangles_about_the_axis() {
    let mut random = Random(53);
    for (p, q) in (1..=4).flat_map(|p| (1..=4).map(move |q| (p, q))) {
        let top = Bounds::hexagon(p, q).region();
        for signs in [repeated("+-", 6), repeated("-++", 6), random.signs(7)] {
            is_symmetric(&Pile::under(top, stacking(&signs)).unwrap(), p - q);
        }
    }
}

#[test]
#[should_panic(expected = "assertion")]
fn a_load_off_the_axis_breaks_the_symmetry() {
    let pile = Pile::under(Region::SITE, stacking("+-+")).unwrap();
    let site = Site { i: 1, j: 0, k: 1 };
    is_symmetric(&pile.with_load(site, ratio(1, 9)).unwrap(), 0);
}
