//! Two layers on a rough floor: exact forces are accepted, and each fault is named.

use cannonpile::shape::Selection;
use cannonpile::{Load, Packing, Pile};
use cannonpile_dem::scene::Floor;
use cannonpile_dem::table::FileFormat;
use cannonpile_dem::verify::{Comparison, Finding, FindingKind, Measured, Reader, Refusal, Report};
use cannonpile_stability::RoughPacking;
use num_rational::BigRational;

use super::{packing, ratio};
use cannonpile::lattice::{Region, Site};

type Vector = [f64; 3];

/// The rows of a perfect simulation: contacts with the normal and the tangential force on the upper sphere, and the forces of
/// the floor.
struct Rows {
    contacts: Vec<([u64; 2], Vector, Vector)>,
    floor: Vec<(u64, Vector)>,
}

fn perfect(packing: &Packing<'_>) -> Rows {
    let (pile, rough) = (packing.pile(), RoughPacking::new(packing).unwrap());
    let id = |site| super::id(pile, site);
    let contacts = rough.contacts(Selection::All).unwrap().map(|contact| {
        let contact = contact.unwrap();
        let below = pile.shape().below(contact.site, contact.direction).unwrap();
        let normal = contact.normal_vector.map(|x| x.nearest::<f64>().unwrap());
        let tangential = contact.tangential_vector.map(|x| x.nearest().unwrap());
        ([id(contact.site), id(below)], normal, tangential)
    });
    let floor = rough.base(Selection::Base).unwrap().map(|force| {
        let force = force.unwrap();
        let [x, y, z] = [force.shear_x, force.shear_y, force.normal].map(|x| x.nearest::<f64>());
        (id(force.site), [-x.unwrap(), -y.unwrap(), z.unwrap()])
    });
    Rows {
        contacts: contacts.collect(),
        floor: floor.collect(),
    }
}

impl Rows {
    /// Returns a table of contacts, and one of the floor that lists all spheres.
    fn tables(&self) -> [String; 2] {
        let mut contacts = "id1,id2,fx,fy,fz,tx,ty,tz\n".to_owned();
        for ([one, other], [x, y, z], [u, v, w]) in &self.contacts {
            let forces = [x, y, z, u, v, w].map(|part| format!("{part:?}")).join(",");
            contacts.extend([format!("{one},{other},{forces}\n")]);
        }
        let mut floor = "id,fx,fy,fz\n1,0,0,0\n".to_owned();
        for (id, [x, y, z]) in &self.floor {
            floor.extend([format!("{id},{x:?},{y:?},{z:?}\n")]);
        }
        [contacts, floor]
    }

    /// Returns the forces of the floor, whose number is 0, as contacts.
    fn on_floor(&self) -> impl Iterator<Item = Measured> {
        let walls = self.floor.iter();
        walls.map(|(id, force)| Measured::of_vector([*id, 0], *force))
    }

    fn compare(&self, packing: &Packing<'_>) -> Comparison {
        let [contacts, floor] = self.tables();
        let reader = Reader::new().on_floor(Floor::Rough);
        let compared = if self.floor.is_empty() {
            reader.compare(packing, contacts.as_bytes())
        } else {
            reader.compare_with_floor(packing, contacts.as_bytes(), floor.as_bytes())
        };
        compared.unwrap().comparison
    }

    /// Returns the only finding.
    fn finding(&self, packing: &Packing<'_>) -> Finding {
        let comparison = self.compare(packing);
        assert!(!comparison.accepted(1e-9));
        let mut findings = comparison.findings(1e-9);
        if self.floor.is_empty() {
            let kind = findings.pop().map(|finding| finding.kind);
            assert_eq!(kind, Some(FindingKind::OffFloor));
        }
        assert_eq!(findings.len(), 1, "{findings:?}");
        findings.remove(0)
    }
}

fn four() -> Pile {
    Pile::triangular(2).unwrap()
}

fn piles() -> Vec<(Pile, BigRational)> {
    let load = |weight: i64| Load::from(ratio(weight, 1));
    let hexagon = Pile::under(Region::hexagon(2, 3).unwrap(), "+".parse().unwrap()).unwrap();
    let bottom = Site { i: 1, j: 0, k: 1 };
    let loaded = hexagon.clone().with_load(Site::APEX, load(3)).unwrap();
    vec![
        (four(), ratio(6, 5)),
        (Pile::discs(2).unwrap(), ratio(6, 5)),
        (Pile::isosceles(2, ratio(2, 5)).unwrap(), ratio(6, 5)),
        (hexagon, ratio(11, 10)),
        (loaded.with_load(bottom, load(1)).unwrap(), ratio(4, 3)),
    ]
}

#[test]
fn exact_forces_are_accepted() {
    for (pile, spacing) in piles() {
        let packing = packing(&pile, spacing);
        let rows = perfect(&packing);
        let comparison = rows.compare(&packing);
        assert!(comparison.accepted(1e-14), "{comparison}");
        assert_eq!(comparison.tangential(), rows.contacts.len() as u64);
        assert_eq!(comparison.floor(), rows.floor.len() as u64);
        assert_eq!(comparison.floor_friction_error(), Some(0.0));
        assert_eq!(comparison.tangential_error(), Some(0.0));
        assert!(comparison.net_moment().unwrap().1 < 1e-14);
        // Whole forces, in the other order, with the walls in the same list.
        let whole = |[a, b, c]: Vector, [x, y, z]: Vector| [a + x, b + y, c + z];
        let contacts = rows.contacts.iter().map(|(ids, normal, tangential)| {
            Measured::of_vector(*ids, whole(*normal, *tangential)).reversed()
        });
        let all = contacts.chain(rows.on_floor());
        let comparison = Comparison::on_rough_floor(&packing, all).unwrap();
        assert!(comparison.accepted(1e-14), "{comparison}");
        assert_eq!(comparison.tangential(), rows.contacts.len() as u64);
        assert!(comparison.net_moment().unwrap().1 < 1e-14);
        // The frictionless forces of the same pile are others.
        let glued = Comparison::new(&packing, super::perfect(&packing)).unwrap();
        assert!(glued.accepted(0.0));
        assert!(
            !Comparison::on_rough_floor(&packing, super::perfect(&packing))
                .unwrap()
                .accepted(0.01)
        );
    }
}

#[test]
fn contacts_are_found_by_position_in_any_frame() {
    let pile = Pile::under(Region::hexagon(2, 3).unwrap(), "+".parse().unwrap()).unwrap();
    let packing = packing(&pile, ratio(6, 5));
    let rows = perfect(&packing);
    let centres: Vec<Vector> = {
        let sites = pile
            .shape()
            .sites()
            .map(|site| packing.position(site).unwrap());
        sites
            .map(|centre| centre.map(|x| x.nearest::<f64>().unwrap()))
            .collect()
    };
    let centre = |id: u64| centres[usize::try_from(id).unwrap() - 1];
    // x, y and z become y, z and x.
    let text = |[x, y, z]: Vector| format!("{z:?},{x:?},{y:?}");
    let mut table = "x1,y1,z1,x2,y2,z2,fx,fy,fz,tx,ty,tz\n".to_owned();
    let mut points = "x,y,z,fx,fy,fz,tx,ty,tz\n".to_owned();
    for ([one, other], normal, tangential) in &rows.contacts {
        let places = [centre(*one), centre(*other)];
        let forces = format!("{},{}\n", text(*normal), text(*tangential));
        table.extend([
            text(places[0]),
            ",".into(),
            text(places[1]),
            ",".into(),
            forces,
        ]);
        let middle = [0, 1, 2].map(|n| places[0][n].midpoint(places[1][n]));
        // The force on the lower sphere is as good.
        let back = |vector: Vector| text(vector.map(|x| -x));
        let parts = [text(middle), back(*normal), back(*tangential)];
        points.extend([parts.join(","), "\n".into()]);
    }
    for (id, force) in &rows.floor {
        let centre = centre(*id);
        let below = |depth: f64| text([centre[0], centre[1], centre[2] - depth]);
        let force = text(*force) + ",0,0,0\n";
        table.extend([
            text(centre),
            ",".into(),
            below(2.0),
            ",".into(),
            force.clone(),
        ]);
        points.extend([below(1.0), ",".into(), force]);
    }
    for table in [table, points] {
        let reader = Reader::new().by_place(0.1).unwrap().on_floor(Floor::Rough);
        let compared = reader.compare(&packing, table.as_bytes()).unwrap();
        assert!(compared.frame.is_some());
        assert_eq!(
            compared
                .comparison
                .tangential_error()
                .map(|error| error < 1e-12),
            Some(true)
        );
        assert!(
            compared.comparison.accepted(1e-12),
            "{}",
            compared.comparison
        );
    }
}

#[test]
fn each_fault_is_named() {
    for (pile, spacing) in piles() {
        let packing = packing(&pile, spacing);
        let rows = || perfect(&packing);
        let says = |rows: &Rows, parts: [&str; 2]| {
            let finding = rows.finding(&packing);
            let is_said = parts.iter().all(|part| finding.text.contains(part));
            assert!(is_said, "{finding}: {parts:?}");
        };
        let counted = |count: u64, noun: &str| {
            let plural = if count == 1 { "" } else { "s" };
            format!("{count} {noun}{plural}")
        };
        let changed = |change: fn(f64) -> f64| {
            let mut rows = rows();
            for (_, _, tangential) in &mut rows.contacts {
                *tangential = tangential.map(change);
            }
            // Without the floor there is no moment on a lower sphere.
            rows.floor.clear();
            rows
        };
        let all = rows().contacts.len() as u64;
        if pile.loads().len() == 0 {
            let at = format!(", at {}", counted(all, "contact"));
            let right = "normal forces are right, but";
            says(
                &changed(|x| -x),
                [
                    &format!("{right} all tangential forces have the wrong sign{at}"),
                    "",
                ],
            );
            says(
                &changed(|_| 0.0),
                [&format!("{right} all tangential forces are 0{at}"), ""],
            );
            says(
                &changed(|x| 2.0 * x),
                [
                    &format!("{right} tangential forces are "),
                    &format!("times the exact values{at}"),
                ],
            );
        }
        let mut one = rows();
        one.contacts[0].2[0] += 0.01;
        one.floor.clear();
        says(
            &one,
            [
                "tangential forces are wrong at 1 contact, most between spheres 1 and ",
                "",
            ],
        );
        // The floor: forces of the spheres on it, no friction, and friction below one sphere.
        let needing = |rows: &Rows| {
            let [x, y] = [0, 1].map(|n| move |force: &Vector| force[n].abs() > 1e-9);
            rows.floor
                .iter()
                .filter(|(_, force)| x(force) || y(force))
                .count() as u64
        };
        let on_floor = |change: fn(f64) -> f64| {
            let mut rows = rows();
            for (_, [x, y, _]) in &mut rows.floor {
                (*x, *y) = (change(*x), change(*y));
            }
            rows
        };
        let below = format!(", below {}", counted(needing(&rows()), "sphere"));
        says(
            &on_floor(|x| -x),
            [
                &format!("the friction of the floor has the wrong sign{below}"),
                "",
            ],
        );
        says(
            &on_floor(|_| 0.0),
            [&format!("the floor has no friction{below}"), ""],
        );
        let mut one = rows();
        one.floor.last_mut().unwrap().1[1] += 0.01;
        says(
            &one,
            [
                "the friction of the floor is wrong below 1 sphere, most below sphere ",
                "",
            ],
        );
    }
}

#[test]
fn spheres_that_do_not_turn_are_named() {
    let pile = four();
    let packing = packing(&pile, ratio(6, 5));
    let mut rows = perfect(&packing);
    // The horizontal forces on each sphere balance, but not the moments: the contacts rub more, and press less.
    for (_, normal, tangential) in &mut rows.contacts {
        let unit = normal.map(|x| 3.0 * x);
        let turned = [
            -unit[0] * unit[2],
            -unit[1] * unit[2],
            1.0 - unit[2] * unit[2],
        ];
        for n in 0..3 {
            normal[n] *= 0.9;
            tangential[n] += 0.1 * turned[n] / (3.0 * unit[2].mul_add(-unit[2], 1.0) / unit[2]);
        }
    }
    for (id, force) in &mut rows.floor {
        for n in 0..2 {
            let (_, normal, tangential) = rows
                .contacts
                .iter()
                .find(|([_, lower], ..)| lower == id)
                .unwrap();
            force[n] = normal[n] + tangential[n];
        }
    }
    let findings = rows.compare(&packing).findings(1e-9);
    let is_moment = |finding: &Finding| finding.kind == FindingKind::Moment;
    assert!(findings.iter().any(is_moment), "{findings:?}");
    // A common factor of all forces is another gravity.
    let mut rows = perfect(&packing);
    let contacts = rows
        .contacts
        .iter_mut()
        .flat_map(|(_, normal, tangential)| [normal, tangential]);
    for force in contacts.chain(rows.floor.iter_mut().map(|(_, force)| force)) {
        *force = force.map(|x| 9.81 * x);
    }
    let finding = rows.finding(&packing);
    assert!(finding.text.starts_with("all forces are 9.81"), "{finding}");
}

#[test]
fn a_fallen_pile_is_named() {
    let pile = Pile::under(Region::hexagon(2, 2).unwrap(), "+".parse().unwrap()).unwrap();
    let packing = packing(&pile, ratio(6, 5));
    let mut rows = perfect(&packing);
    rows.floor
        .splice(0..0, [(3, [0.0, 0.0, 1.0]), (5, [0.0, 0.0, 1e-3])]);
    let finding = rows.finding(&packing);
    assert_eq!(finding.kind, FindingKind::Fallen);
    let said = "sphere 3 and another touch the floor, but are above the bottom layer: has the pile fallen?";
    assert_eq!(finding.to_string(), said);
}

#[test]
fn tables_of_the_floor_are_refused_with_a_reason() {
    let pile = four();
    let packing = packing(&pile, ratio(6, 5));
    let rows = perfect(&packing);
    let [contacts, floor] = rows.tables();
    let compare = |contacts: &str, floor: &str| {
        let reader = Reader::new().on_floor(Floor::Rough);
        reader.compare_with_floor(&packing, contacts.as_bytes(), floor.as_bytes())
    };
    let refused = |contacts: &str, floor: &str| compare(contacts, floor).unwrap_err().to_string();
    assert_eq!(
        refused(&contacts, "id,fx,fy,fz\n7,0,0,1\n"),
        "table of the floor: line 2: no sphere 7: the spheres of this scene are numbered 1 to 4, from the top; does the table \
         have more layers, or several numbers for one wall?"
    );
    assert!(refused(&contacts, "id,fx,fz\n2,0,1\n").starts_with("table of the floor: line 1: "));
    assert!(refused(&contacts, "id,fx,fy,fz\n").starts_with("table of the floor: "));
    let twice = contacts.clone() + "2,0,0,0,1,0,0,0\n";
    assert!(refused(&twice, &floor).contains("both tables list contacts with the floor"));
    // Without tangential forces nothing is accepted.
    let normal =
        "id1,id2,force\n1,2,0.3333333333333333\n1,3,0.3333333333333333\n1,4,0.3333333333333333\n";
    let compared = compare(normal, &floor).unwrap().comparison;
    assert_eq!(
        (compared.tangential(), compared.tangential_error()),
        (0, None)
    );
    assert!(!compared.accepted(1e-12) && compared.net_moment().is_none());
    let said =
        "the tangential force is not known at 3 contacts between spheres and 0 with the floor";
    assert!(compared.findings(1e-12)[0].text.starts_with(said));
    // Each bottom sphere needs a row.
    let [contacts, floor] = rows.tables();
    let all_but_one = floor.lines().take(4).collect::<Vec<_>>().join("\n");
    let compared = compare(&contacts, &all_but_one).unwrap().comparison;
    let said = "the force of the floor is missing below 1 bottom sphere, first sphere 4";
    assert!(compared.findings(1e-12)[0].text.starts_with(said));
    // A sphere has one row.
    let twice = floor.clone() + "3,9,9,1.3333333333333333\n";
    assert!(refused(&contacts, &twice).contains("line 6: sphere 3 is in an earlier row too"));
    let endless = "step,id,fx,fy,fz\n".to_owned() + &"1,1,0,0,0\n".repeat(1000);
    assert!(refused(&contacts, &endless).contains("line 3: sphere 1 is in an earlier row too"));
    // Rows of the floor that are left out are reported.
    let with_steps = floor.replace('\n', "\n5,").replace("id,", "step,id,");
    let with_steps = with_steps.trim_end_matches("5,").to_owned();
    let earlier = with_steps.replace("step,id,fx,fy,fz\n5,", "step,id,fx,fy,fz\n4,9,9,9,9\n5,");
    let compared = compare(&contacts, &(earlier + "#5,1,0,0,0\nend\n")).unwrap();
    let rows = compared.floor_rows.as_ref().unwrap();
    assert_eq!((rows.used, compared.rows.other_steps), (4, 0));
    let mut text = Vec::new();
    Report::of_file(&compared, 1e-9)
        .write(FileFormat::Text, &mut text)
        .unwrap();
    let text = String::from_utf8(text).unwrap();
    let said = "left_out: table of the floor: 1 row of another step, 1 comment that looks like a row, 1 line of text (line 8)";
    assert!(text.contains(said), "{text}");
    // Contacts may be missing, if the floor was measured.
    let compared = compare("id1,id2,force\n2,3,0\n", &floor)
        .unwrap()
        .comparison;
    assert_eq!((compared.missing(), compared.floor()), (3, 3));
    // Three layers have no unique forces.
    let three = Pile::triangular(3).unwrap();
    let three = super::packing(&three, ratio(6, 5));
    let refused = Comparison::on_rough_floor(&three, []).unwrap_err();
    assert!(matches!(refused, Refusal::Scene(_)), "{refused}");
}

#[test]
fn infinite_tangential_forces_are_refused() {
    let pile = four();
    let packing = packing(&pile, ratio(6, 5));
    let row = Measured::new([1, 2], 0.3).with_tangential([0.0, f64::INFINITY, 0.0]);
    let refused = Comparison::on_rough_floor(&packing, [row]).unwrap_err();
    assert_eq!(
        refused.to_string(),
        "entry 1: a tangential force is inf: forces and positions must be finite"
    );
}

#[test]
fn residual_forces_include_tangential_ones() {
    let pile = four();
    let packing = packing(&pile, ratio(6, 5));
    let [contacts, _] = perfect(&packing).tables();
    let reader = Reader::new().on_floor(Floor::Rough);
    let unbalanced = reader
        .compare(&packing, contacts.as_bytes())
        .unwrap()
        .unbalanced;
    assert!(unbalanced.greatest().unwrap().1 < 1e-15);
}

#[test]
fn spheres_of_the_bottom_layer_do_not_touch() {
    let pile = four();
    let packing = packing(&pile, ratio(6, 5));
    let [contacts, floor] = perfect(&packing).tables();
    let touching = contacts + "2,3,0.5,0,0,0,0,0\n";
    let reader = Reader::new().on_floor(Floor::Rough);
    let compared = reader.compare_with_floor(&packing, touching.as_bytes(), floor.as_bytes());
    let comparison = compared.unwrap().comparison;
    assert_eq!((comparison.extra(1e-6), comparison.fixed()), (1, 0));
    assert!(!comparison.accepted(1e-6));
}

#[test]
fn a_force_column_beside_the_whole_force_is_the_normal_force() {
    let pile = four();
    let packing = packing(&pile, ratio(6, 5));
    let rows = perfect(&packing);
    for (factor, accepted) in [
        (1.0, true),
        (1.0 + 1e-9, true),
        (1.078, false),
        (-1.0, false),
    ] {
        let measured = rows.contacts.iter().map(|(ids, normal, tangential)| {
            let whole = [0, 1, 2].map(|n| normal[n] + tangential[n]);
            Measured::new(*ids, factor / 3.0).with_vector(whole)
        });
        let measured = measured.chain(rows.on_floor());
        let comparison = Comparison::on_rough_floor(&packing, measured).unwrap();
        assert_eq!(comparison.accepted(1e-6), accepted, "{factor}");
    }
}

#[test]
fn piles_far_from_the_origin_lose_no_digits() {
    let far = 1_000_000_000_000;
    let top = Region::new(far..=far, -far..=-far, 0..=0).unwrap();
    let pile = Pile::under(top, "+".parse().unwrap()).unwrap();
    let packing = packing(&pile, ratio(6, 5));
    let rows = perfect(&packing);
    let measured = rows.contacts.iter().map(|(ids, normal, tangential)| {
        Measured::of_vector(*ids, [0, 1, 2].map(|n| normal[n] + tangential[n]))
    });
    let measured = measured.chain(rows.on_floor());
    assert!(
        Comparison::on_rough_floor(&packing, measured)
            .unwrap()
            .accepted(1e-14)
    );
}

#[test]
fn columns_of_tangential_forces_are_complete_or_a_sum() {
    let pile = four();
    let packing = packing(&pile, ratio(6, 5));
    let rows = perfect(&packing);
    let [contacts, floor] = rows.tables();
    let whole = Rows {
        contacts: rows
            .contacts
            .iter()
            .map(|(ids, normal, tangential)| {
                (
                    *ids,
                    [0, 1, 2].map(|n| normal[n] + tangential[n]),
                    *tangential,
                )
            })
            .collect(),
        floor: rows.floor.clone(),
    };
    let [whole, _] = whole.tables();
    let reader = Reader::new().on_floor(Floor::Rough);
    let incomplete = contacts.replace(",ty,tz", ",a,b");
    let refused = reader.compare(&packing, incomplete.as_bytes()).unwrap_err();
    assert!(refused.to_string().contains("no column ty"), "{refused}");
    let read = |columns: &str, table: &str| {
        let reader = reader.clone().with_columns(columns.parse().unwrap());
        let compared = reader.compare_with_floor(&packing, table.as_bytes(), floor.as_bytes());
        compared.unwrap().comparison
    };
    for (columns, table) in [
        ("", &contacts),
        // A mapped vector leaves the tangential columns alone.
        ("fx=fx,fy=fy,fz=fz", &contacts),
        ("fx=#3,fy=#4,fz=#5", &contacts),
        ("fx=-1*fx+2*fx,fy=fy,fz=fz", &contacts),
        // A sum is the whole force.
        ("fx=fx+tx,fy=fy+ty,fz=fz+tz", &contacts),
        ("fx=tx+#3,fy=#4+#7,fz=fz+tz", &contacts),
        // A difference is the normal force.
        ("fx=fx-tx,fy=fy-ty,fz=fz-tz", &whole),
        ("fx=fx - tx,fy=\"fy\"-ty,fz=fz+-tz", &whole),
        ("fx=#3-#6,fy=#4-#7,fz=#5-#8", &whole),
    ] {
        let compared = if columns.is_empty() {
            let compared = reader.compare_with_floor(&packing, table.as_bytes(), floor.as_bytes());
            compared.unwrap().comparison
        } else {
            read(columns, table)
        };
        assert!(compared.accepted(1e-14), "{columns}: {compared}");
        assert_eq!(compared.tangential(), 3);
    }
    // Whole and tangential forces side by side.
    let compared = read("fx=fx,fy=fy,fz=fz", &whole);
    assert!(!compared.accepted(1e-3));
    assert_eq!(compared.findings(1e-3)[0].kind, FindingKind::Whole);
    // A name may contain the sign.
    let renamed = contacts.replacen("fx", "fx-tx", 1);
    assert!(read("fx=fx-tx,fy=fy,fz=fz", &renamed).accepted(1e-14));
}

#[test]
fn a_table_of_a_floor_with_glue_is_judged_by_normal_forces() {
    let pile = four();
    let packing = packing(&pile, ratio(6, 5));
    let contacts = "id1,id2,force\n1,2,0.46225016352102427\n1,3,0.46225016352102427\n1,4,0.46225016352102427\n";
    let compare = |floor: &str| {
        let compared =
            Reader::new().compare_with_floor(&packing, contacts.as_bytes(), floor.as_bytes());
        compared.unwrap().comparison
    };
    let head = "id,fx,fy,fz\n1,0,0,0\n";
    let row = |id: u64, x: f64, z: f64| format!("{id},{x:?},0,{z:?}\n");
    let normal = 4.0 / 3.0;
    // The shear force of the glue is not judged.
    let floor = [2, 3, 4].map(|id| row(id, 9.0, normal)).concat();
    let comparison = compare(&(head.to_owned() + &floor));
    assert!(comparison.accepted(0.0), "{comparison}");
    assert_eq!(
        (comparison.floor(), comparison.floor_friction_error()),
        (3, None)
    );
    let wrong =
        head.to_owned() + &row(2, 0.0, normal) + &row(3, 0.0, 2.0 * normal) + &row(4, 0.0, normal);
    let comparison = compare(&wrong);
    assert_eq!(comparison.floor_error(), Some(1.0));
    assert!(!comparison.accepted(0.1));
    let lost = head.to_owned() + &row(2, 0.0, normal);
    let said = "the force of the floor is missing below 2 bottom spheres, first sphere 3";
    assert!(compare(&lost).findings(0.1)[0].text.starts_with(said));
}
