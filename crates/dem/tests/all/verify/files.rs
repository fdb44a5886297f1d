//! Files are read as measurements, and rows that do not match the pile name the line.

use cannonpile::Pile;
use cannonpile_dem::verify::{self, Measured, Reader};

use super::{packing, ratio};

#[test]
fn rows_are_measurements() {
    let read = |text: &str| verify::read(text.as_bytes());
    let alone = "id1,id2,fx,fy,fz\n1,2,2,1,2\n4,1,0,3,4\n";
    let want = [
        Measured::of_vector([1, 2], [2.0, 1.0, 2.0]),
        Measured::of_vector([4, 1], [0.0, 3.0, 4.0]),
    ];
    assert_eq!(want.map(|measured| measured.force), [3.0, -5.0]);
    assert_eq!(read(alone).unwrap(), want);
    let vectors = "fz,force,id1,id2,fx,fy\n3,0.5,1,2,1,-2\n";
    let want = Measured::new([1, 2], 0.5).with_vector([1.0, -2.0, 3.0]);
    assert_eq!(read(vectors).unwrap(), [want]);
    assert_eq!(
        read("id1,id2,force\n1,-2,1\n").unwrap_err().to_string(),
        "line 2: id2 '-2' is not a number of at least 0"
    );
}

const HEAD: &str =
    "ITEM: TIMESTEP\n7\nITEM: NUMBER OF ENTRIES\n2\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\n";

#[test]
fn rows_that_do_not_match_the_pile_name_the_line() {
    let pile = Pile::triangular(2).unwrap();
    let packing = packing(&pile, ratio(6, 5));
    let compared = |text: &str| {
        let read = Reader::new().compare(&packing, text.as_bytes());
        read.unwrap_err().to_string()
    };
    let spheres = "the spheres of this scene are numbered 1 to 4, from the top";
    let once = "list each pair once, or once in each order; if the table holds several steps, name their column with \
                step=COLUMN in --columns, or leave one step";
    for (text, want) in [
        (
            "id1,id2,force\n\n1,5,1\n",
            format!(
                "line 3: no sphere 5: {spheres}; does the table have more layers, or several numbers for one wall?"
            ),
        ),
        (
            "id1,id2,force\n2,2,1\n",
            "line 2: sphere 2 is paired with itself: name two different spheres".into(),
        ),
        (
            "id1,id2,force\n1,2,1\n1,3,1\n\n\n2,1,1\n3,1,1\n1,3,2\n",
            format!("line 8: spheres 1 and 3 are already on line 3: {once}"),
        ),
        (
            "id1,id2,force\n\n\n1,3,1\n1,4,1\n\n1,3,2\n",
            format!("line 7: spheres 1 and 3 are already on line 4: {once}"),
        ),
    ] {
        assert_eq!(compared(text), want);
    }
}

/// Four spheres have at most 2·(3 + 2·80) rows.
#[test]
fn tables_without_end_are_refused() {
    let pile = Pile::triangular(2).unwrap();
    let packing = packing(&pile, ratio(6, 5));
    let compare = |reader: Reader, begin: &str, again: &str| {
        let endless = begin.to_owned() + &again.repeat(10_000);
        let refused = reader.compare(&packing, endless.as_bytes()).unwrap_err();
        refused.to_string()
    };
    let [head, with_steps] = ["id1,id2,force\n", "step,id1,id2,force\n"];
    let dump = HEAD.replace("\n2\n", "\n10000\n") + "ITEM: ENTRIES id1 id2 force\n";
    let full = "more than 326 entries: leave out pairs that do not touch";
    let again = "spheres 1 and 2 are already on line 2";
    for (begin, row, said) in [
        (head, "2,0,1\n", full),
        (with_steps, "7,2,0,1\n", full),
        (&dump, "2 0 1\n", full),
        (head, "1,2,1\n", again),
        (with_steps, "7,1,2,1\n", again),
    ] {
        let refused = compare(Reader::new(), begin, row);
        assert!(refused.contains(said), "{refused}");
        assert!(refused.starts_with("line "), "{refused}");
    }
    // A row without a force may have any position.
    let by_place = Reader::new().by_place(0.1).unwrap();
    let refused = compare(by_place, "x,y,z,force\n", "7,7,7,0\n");
    assert!(
        refused.starts_with("line 329: more than 327 rows"),
        "{refused}"
    );
}
