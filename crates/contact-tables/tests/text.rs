//! Valid texts and dumps are read correctly, and errors in files name the line.

use std::io::Read;

use contact_tables::{Error, Force, Format, Spheres};

/// Returns the numbers of the spheres and the force of each row.
fn rows(input: impl Read) -> Result<Vec<([i64; 2], Force)>, Error> {
    let rows = contact_tables::read(input, &Format::default())?;
    let rows = rows.map(|row| {
        row.map(|row| match row.spheres {
            Spheres::Numbers(ids) => (ids, row.force),
            Spheres::Places(place) => panic!("{place:?}"),
        })
    });
    rows.collect()
}

#[track_caller]
fn read(text: &str) -> Vec<([i64; 2], Force)> {
    rows(text.as_bytes()).unwrap()
}

#[track_caller]
fn refused(text: impl AsRef<[u8]>) -> String {
    let line = rows(text.as_ref()).unwrap_err().to_string();
    assert!(!line.contains(char::is_control), "{line:?}");
    line
}

#[test]
fn columns_are_found_by_name() {
    let want = [([1, 2], Force::Along(0.5)), ([3, 1], Force::Along(2e-7))];
    for text in [
        "id1,id2,force\n1,2,0.5\n3,1,2e-7\n",
        "id1,id2,force\n1,2,0.5\n3,1,2e-7",
        "id1,id2,force\r\n1,2,0.5\r\n3,1,2e-7\r\n",
        "\u{feff}id1,id2,force\n1,2,0.5\n\n3,1,2e-7\n\n",
        "\n  \nforce,id2,x,id1,y\n.5,2,a,1,b\n0.0000002,1,,3,\n",
        "ID1,Id2,FORCE\n1,2,0.5\n3,1,2e-7\n",
        "ID1,id1,id2,Force,force\nx,1,2,x,0.5\nx,3,1,x,2e-7\n",
        "\"id1\",\"id2\",\"force\"\n\"1\",\"2\",\"0.5\"\n\"3\",\"1\",\"2E-7\"\n",
        "note,id1,id2,force\n\"a, \"\"b\"\"\",1,2,5e-1\n,3,1,2.0e-07\n",
        " id1 , id2 , force \n 1 , 2 , +0.5 \n 003 , 1 , 20e-8 \n",
        "patom1,patom2,force\n1.0,2.000,0.5\n3.,1,2e-7\n",
        "id1,id2,force\n1.000000000000000000e+00,2.0e0,0.5\n0.3e+1,1.0E0,2e-7\n",
    ] {
        assert_eq!(read(text), want, "{text:?}");
    }
    let vectors = "fz,force,id1,id2,fx,fy\n3,0.5,1,2,1,-2\n";
    let want = ([1, 2], Force::Both(0.5, [1.0, -2.0, 3.0]));
    assert_eq!(read(vectors), [want]);
    let alone = "id1,id2,fx,fy,fz\n1,2,2,1,2\n";
    assert_eq!(read(alone), [([1, 2], Force::Vector([2.0, 1.0, 2.0]))]);
    assert_eq!(read("id1,id2,force\n"), []);
}

#[test]
fn forces_are_read_correctly_rounded() {
    let text = "id1,id2,force\n1,2,0.46225016352102424999999999999999999999\n1,3,4.9e-324\n1,4,-1.7976931348623157e308\n";
    let forces = [0.462_250_163_521_024_25, f64::from_bits(1), f64::MIN];
    let got: Vec<Force> = read(text).into_iter().map(|(_, force)| force).collect();
    assert_eq!(got, forces.map(Force::Along));
}

#[test]
fn unusable_headers_are_rejected() {
    let columns = "name the columns id1, id2, force, and fx, fy, fz if there are vectors (in LAMMPS with dump_modify colname)";
    let nothing =
        "the table is empty: begin with a header such as id1,id2,force, or with ITEM: TIMESTEP";
    for (text, want) in [
        ("", format!("line 1: {nothing}")),
        ("\n\n", format!("line 1: {nothing}")),
        (
            "id1,force\n",
            format!("line 1: no column id2, only 'id1', 'force': {columns}"),
        ),
        (
            "id1/id2/force\n",
            format!("line 1: no column id1, only 'id1/id2/force': {columns}"),
        ),
        (
            "1,2,0.5\n",
            "line 1: there is no header above the 3 columns: name them by number, such as id1=#1,id2=#2,force=#3".into(),
        ),
        (
            "ID1,Id1,id2,force\n",
            "line 1: two columns, 'ID1' and 'Id1', for id1: choose one by its number, id1=#N".into(),
        ),
        (
            "id1,id2,fx,fz\n",
            format!("line 1: no column fy, only 'id1', 'id2', 'fx', 'fz': {columns}"),
        ),
        (
            "id1,id2,force,force\n",
            "line 1: two columns, 'force' and 'force', for force: choose one by its number, force=#N".into(),
        ),
        (
            "id1,patom1,id2,force\n",
            "line 1: two columns, 'id1' and 'patom1', for id1: choose one by its number, id1=#N".into(),
        ),
    ] {
        assert_eq!(refused(text), want);
    }
}

#[test]
fn errors_in_csv_tables_name_the_line() {
    let number = "not a number such as 0.46 or 1e-3";
    let id = "not the number of a sphere, such as 17, with all its digits (in LAMMPS by dump_modify format float %.17g)";
    let finite = "forces and positions must be finite";
    for (text, want) in [
        (
            "id1,id2,force\n1,2\n",
            "line 2: 2 cells, but the header has 3: give every column a value".into(),
        ),
        (
            "id1,id2,force\n1,2,0,5\n",
            "line 2: 4 cells, but the header has 3: does the header lack the name of the first column, as for the row names \
             of R, or does a cell contain the separator?"
                .into(),
        ),
        (
            "id1,id2,force\n1,2,abc\n",
            format!("line 2: force 'abc' is {number}"),
        ),
        (
            "id1,id2,force\n1,2,\n",
            format!("line 2: force '' is {number}"),
        ),
        (
            "id1,id2,force\n1,2,0x1p3\n",
            format!("line 2: force '0x1p3' is {number}"),
        ),
        (
            "id1,id2,force\n1,2,1/3\n",
            format!("line 2: force '1/3' is {number}"),
        ),
        (
            "id1,id2,force,fx,fy,fz\n1,2,1,1,1d,1\n",
            format!("line 2: fy '1d' is {number}"),
        ),
        (
            "id1,id2,force\n1,2,NaN\n",
            format!("line 2: force is NaN: {finite}"),
        ),
        (
            "id1,id2,force\n\n1,2,-inf\n",
            format!("line 3: force is -inf: {finite}"),
        ),
        (
            "id1,id2,force\n1,2,1e999\n",
            format!("line 2: force is inf: {finite}"),
        ),
        (
            "id1,id2,force\n1.5,2,1\n",
            format!("line 2: id1 '1.5' is {id}"),
        ),
        (
            "id1,id2,force\n1,1e+06,1\n",
            format!("line 2: id2 '1e+06' is {id}"),
        ),
        ("id1,id2,force\n,2,1\n", format!("line 2: id1 '' is {id}")),
        (
            "id1,id2,force\n.0,2,1\n",
            format!("line 2: id1 '.0' is {id}"),
        ),
        (
            "id1,id2,force\n18446744073709551616,2,1\n",
            format!("line 2: id1 '18446744073709551616' is {id}"),
        ),
        (
            "id1,id2,force\n1,\"2,1\n",
            "line 2: a quote does not end on its line: close it, set quote to none, or begin the line with # if it is not a row"
                .into(),
        ),
    ] {
        assert_eq!(refused(text), want);
    }
    assert_eq!(
        refused(b"id1,id2,force\n1,2,\xff\n"),
        "line 2: force 'ÿ' is not a number such as 0.46 or 1e-3"
    );
    assert!(refused("x".repeat(1 << 17)).starts_with("line 1: longer than 65536 bytes"));
    let many = vec!["column"; 10_000].join(",");
    assert!(refused(many).len() < 400);
}

const HEAD: &str =
    "ITEM: TIMESTEP\n7\nITEM: NUMBER OF ENTRIES\n2\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\n";

#[test]
fn errors_in_dumps_name_the_line() {
    let rows = |rows: &str| format!("{HEAD}ITEM: ENTRIES id1 id2 force\n{rows}");
    for (text, want) in [
        (
            rows("1 2 0.5 \n"),
            "line 10: the snapshot ends after 1 of 2 entries: it is not complete",
        ),
        (
            rows(""),
            "line 9: the snapshot ends after 0 of 2 entries: it is not complete",
        ),
        (
            rows("1 2 0.5\n1 3 0.5"),
            "line 11: the dump ends here, within a line or a header: it is not complete",
        ),
        (
            rows("1 2 0.5\nITEM: TIMESTEP\n8\n"),
            "line 11: the snapshot ends after 1 of 2 entries: it is not complete",
        ),
        (
            rows("1 2 0.5\n1 3\n"),
            "line 11: 2 cells, but the header has 3: give every column a value",
        ),
        (
            rows("1 2 0.5\n1 3 x\n"),
            "line 11: force 'x' is not a number such as 0.46 or 1e-3",
        ),
        (
            rows("1 2 1\n1 3 1\n1 4 1\n"),
            "line 12: '1 4 1' is not a line that begins with ITEM: (are there more entries than announced?)",
        ),
        (
            HEAD.into(),
            "line 8: the dump ends here, within a line or a header: it is not complete",
        ),
        (
            HEAD.replace("\n7\n", "\nseven\n"),
            "line 2: 'seven' is not a time step such as 500",
        ),
        (
            HEAD.replace("\n2\n", "\n-2\n"),
            "line 4: '-2' is not a number of entries such as 495",
        ),
        (
            "ITEM: TIMESTEP\n7\nITEM: ENTRIES id1 id2 force\n".into(),
            "line 3: 'ENTRIES id1 id2 force' is not an item of a LAMMPS dump local file: TIMESTEP, NUMBER OF ENTRIES, BOX \
             BOUNDS, ENTRIES",
        ),
        (
            format!("{HEAD}ITEM: ATOMS id type x y z\n"),
            "line 9: 'ATOMS id type x y z' is not an item of a LAMMPS dump local file: TIMESTEP, NUMBER OF ENTRIES, BOX \
             BOUNDS, ENTRIES",
        ),
    ] {
        assert_eq!(refused(text), want);
    }
    let unnamed = refused(format!("{HEAD}ITEM: ENTRIES c_i[1] c_i[2] c_f\n"));
    assert!(
        unnamed
            .starts_with("line 9: no column id1, only 'c_i[1]', 'c_i[2]', 'c_f': name the columns")
    );
    // The announced number of entries takes no memory before the entries are read.
    let huge = HEAD.replace("\n2\n", "\n18446744073709551615\n");
    let huge = refused(format!("{huge}ITEM: ENTRIES id1 id2 force\n"));
    assert!(huge.ends_with("after 0 of 18446744073709551615 entries: it is not complete"));
    // Earlier snapshots must be complete too, but may have other columns.
    let later = HEAD.replace("\n2\n", "\n0\n");
    let later = later.replace("\n7\n", "\n8\n");
    let two = rows("1 2 0.5\n1 3 0.25\n") + &later + "ITEM: ENTRIES force id2 id1\n";
    assert_eq!(read(&two), []);
}

/// A pipe may deliver one byte at a time.
#[test]
fn reading_in_small_pieces_gives_the_same_result() {
    struct Slow<'t>(&'t [u8]);
    impl std::io::Read for Slow<'_> {
        fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
            let (Some((first, rest)), Some(place)) = (self.0.split_first(), buffer.first_mut())
            else {
                return Ok(0);
            };
            (*place, self.0) = (*first, rest);
            Ok(1)
        }
    }
    let dump = format!("{HEAD}ITEM: ENTRIES id1 id2 force\n1 2 0.5 \n1 3 0.25 \n");
    for text in ["id1,id2,force\r\n1,2,0.5\r\n", &dump] {
        assert_eq!(rows(Slow(text.as_bytes())).unwrap(), read(text));
    }
}
