//! Tables in the formats of other codes: separators, comments, columns, signs, kinds of contacts and first numbers.

use cannonpile::Pile;
use cannonpile_dem::verify::{
    Columns, Compared, DialectOptions, Measured, Preset, Reader, Refusal,
};

use super::{packing, perfect, ratio};
use cannonpile_testkit::codes::{centres, head, row};

fn columns(text: &str) -> Columns {
    text.parse().unwrap()
}

/// Compares a table with a pile of two layers: sphere 1 has three contacts with 0.46225 N each, at a = 6/5 R.
#[track_caller]
fn read(reader: &Reader, table: &str) -> Compared {
    let pile = Pile::triangular(2).unwrap();
    reader
        .compare(&packing(&pile, ratio(6, 5)), table.as_bytes())
        .unwrap()
}

#[track_caller]
fn refused(reader: &Reader, table: &str) -> String {
    let pile = Pile::triangular(2).unwrap();
    let refusal: Refusal = reader
        .compare(&packing(&pile, ratio(6, 5)), table.as_bytes())
        .unwrap_err();
    let line = refusal.to_string();
    assert!(line.len() < 500 && !line.contains('\n'), "{line}");
    line
}

#[test]
fn any_separator_and_comments_are_accepted() {
    for table in [
        "id1,id2,force\n1,2,0.46225\n1,3,0.46225\n1,4,0.46225\n",
        "id1;id2;force\n1;2;0.46225\n1;3;0.46225\n1;4;0.46225\n",
        "id1\tid2\tforce\n1\t2\t0.46225\n1\t3\t0.46225\n1\t4\t0.46225\n",
        "id1 id2   force\n 1 2 0.46225\n1  3 0.46225 \n\n1\t4 0.46225",
        "# id1 id2 force\n1 2 0.46225\n1 3 0.46225\n1 4 0.46225\n",
        "# made on Monday\n#\n## id1, id2, force\n1,2,0.46225\n# half\n1,3,0.46225\n1,4,0.46225\n",
        "# id1 id2 force\n1,2,0.46225\n1,3,0.46225\n1,4,0.46225\n",
        "\u{feff}#id1 id2 force\r\n1 2 0.46225\r\n1 3 0.46225\r\n1 4 0.46225\r\n",
    ] {
        let read = read(&Reader::new(), table);
        assert!(
            read.comparison.accepted(1e-5),
            "{table:?}: {}",
            read.comparison
        );
    }
}

/// Three rows with the exact forces at a = 6/5 R.
fn rows(separator: &str, ending: &str) -> String {
    let row = |id| ["1", id, "0.46225"].join(separator) + ending + "\n";
    ["2", "3", "4"].map(row).concat()
}

#[test]
fn no_row_above_the_first_of_most_cells_is_lost() {
    let others = "1,3,0.46225\n1,4,0.46225\n";
    let header = "id1,id2,force\n";
    for (first, said) in [
        ("1,2,0.46225,5\n", "line 2: 4 cells, but the header has 3"),
        ("1,2\n", "line 2: 2 cells, but the header has 3"),
    ] {
        let line = refused(&Reader::new(), &[header, first, others].concat());
        assert!(line.starts_with(said), "{line}");
    }
    // Without a header, such a line may be a part of a preamble.
    let numbered = Reader::new().with_columns(columns("id1=#1,id2=#2,force=#3"));
    let said = |above: &str| read(&numbered, &[above, others].concat()).rows.to_string();
    let above = "1 line of numbers above the table (line 1)";
    assert_eq!(said("1,2,0.46225,5\n"), above);
    assert_eq!(said("1,2\n"), above);
    assert_eq!(said("id1,id2,force,note\n"), "");
    // The rows of an earlier table.
    let table = ["id1,id2,fx,fy,fz\n1,2,0.1,0.2,0.3\n", header, others].concat();
    let earlier = read(&Reader::new(), &table).rows;
    assert_eq!((earlier.above, earlier.first_above), (1, Some(2)));
}

#[test]
fn a_separator_may_end_the_rows_or_the_header() {
    for table in [
        "id1,id2,force\n".to_owned() + &rows(",", ","),
        "id1,id2,force,\n".to_owned() + &rows(",", ""),
        "id1,id2,force,\n".to_owned() + &rows(",", ","),
        "id1\tid2\tforce\n".to_owned() + &rows("\t", "\t"),
    ] {
        let read = read(&Reader::new(), &table);
        assert!(read.comparison.accepted(1e-5), "{table:?}");
        assert_eq!(read.rows.used, 3);
    }
    let mixed = "id1,id2,force\n1,2,0.46225,\n1,3,0.46225,\n1,4,0.46225\n";
    let line = refused(&Reader::new(), mixed);
    assert!(line.starts_with("line 4: 3 cells"), "{line}");
}

#[test]
fn names_may_be_separated_in_another_way_than_rows() {
    let indexed = "\tid1\tid2\tforce\n0\t1\t2\t0.46225\n1\t1\t3\t0.46225\n2\t1\t4\t0.46225\n";
    for table in [
        "id1 id2 force\n".to_owned() + &rows("\t", ""),
        "id1,id2,force\n".to_owned() + &rows(" ", ""),
        "id1,\tid2,\tforce\n".to_owned() + &rows(",\t", ""),
        // The index of a data frame has no name.
        indexed.to_owned(),
    ] {
        let read = read(&Reader::new(), &table);
        assert!(read.comparison.accepted(1e-5), "{table:?}");
    }
}

#[test]
fn a_row_of_units_is_left_out_on_request() {
    let said = |unit_row, above: &str| {
        let dialect = DialectOptions {
            unit_row: Some(unit_row),
            ..DialectOptions::default()
        };
        let table = ["id1,id2,force\n", above, &rows(",", "")].concat();
        let read = read(&Reader::new().with_dialect(dialect), &table);
        (read.rows.used, read.rows.to_string())
    };
    assert_eq!(said(true, "-,-,N\n"), (3, String::new()));
    let numbers = "1 line of numbers above the table (line 2)".to_owned();
    assert_eq!(said(true, "1,1,1\n"), (3, numbers.clone()));
    // The first row is a contact.
    assert_eq!(said(true, ""), (2, numbers));
    let text = "1 line of text (line 2)".to_owned();
    assert_eq!(said(false, "-,-,N\n"), (3, text));
}

#[test]
fn numbers_above_the_header_are_not_rows() {
    let above = "0 0 0\n9.81 0 10\n";
    let table = [above, "id1 id2 force\n", "- - N\n", &rows(" ", "")].concat();
    let read = read(&Reader::new(), &table);
    assert!(read.comparison.accepted(1e-5));
    let said = "2 lines of numbers above the table (from line 1 on)";
    assert_eq!((read.rows.used, &*read.rows.to_string()), (3, said));
    let dialect = read.dialect.unwrap();
    assert_eq!((dialect.header, dialect.first_row), (Some(3), 5));
}

#[test]
fn only_the_columns_that_are_read_decide_the_decimal_sign() {
    let rows = ["2", "3", "4"].map(|id| format!("1;{id};0,46225;1.5;25.11\n"));
    let table = "id1;id2;force;version;day\n".to_owned() + &rows.concat();
    let read = read(&Reader::new(), &table);
    assert!(read.comparison.accepted(1e-5) && read.dialect.unwrap().decimal_comma);
}

#[test]
fn rows_behind_signs_of_comments_are_read_on_request() {
    let dialect = DialectOptions {
        comment: Some("none".parse().unwrap()),
        ..DialectOptions::default()
    };
    let reader = Reader::new().with_dialect(dialect);
    let table = "#id1,id2,force\n#1,2,0.46225\n# 1,3,0.46225\n1,4,0.46225\n";
    assert!(read(&reader, table).comparison.accepted(1e-5));
}

#[test]
fn comments_behind_rows_are_not_cells() {
    let header = "id1,id2,force\n";
    for table in [
        header.to_owned() + &rows(",", " # measured"),
        "id1 id2 force\n".to_owned() + &rows(" ", " // it is 'so"),
        header.to_owned() + "1,2,0.46225\n1,3,0.46225 # half\n1,4,0.46225\n",
        // A sign within a cell begins no comment.
        "id1,id2,note,force\n1,2,3 #4,0.46225\n1,3,3 #5,0.46225\n1,4,3 #6,0.46225\n".to_owned(),
    ] {
        let read = read(&Reader::new(), &table);
        assert!(read.comparison.accepted(1e-5), "{table:?}");
        assert_eq!(read.rows.used, 3);
    }
}

#[test]
fn a_quoted_cell_may_continue_on_the_next_line() {
    let header = "id1,id2,force,note\n";
    for table in [
        header.to_owned() + &rows(",", ",\"said \"\"a\"\"\nand b\""),
        "id1,id2,force,\"long\nname\"\n".to_owned() + &rows(",", ",a"),
    ] {
        let read = read(&Reader::new(), &table);
        assert!(read.comparison.accepted(1e-5), "{table:?}");
        assert_eq!(read.rows.used, 3);
    }
    // Numbers within a quoted cell are not a row, wherever they are.
    for table in [
        "1,2,0.46225,\"was\n1,3,0.46225,x\"\n1,4,0.46225,\n",
        "1,2,0.46225,\"was\nthis, or\n1,3,0.46225,x\n\"\n1,4,0.46225,\n",
        "1,2,0.46225,\"a\n1,3,0.46225,b\n1,4,0.46225,c\n",
        "1,2,\"a\nb\",0.46225\n1,3,0.46225,\n",
        "\"a\nb\",1,2,0.46225\n",
    ] {
        let line = refused(&Reader::new(), &[header, table].concat());
        assert!(line.starts_with("line 2: a quote does not end"), "{line}");
    }
}

#[test]
fn a_quote_that_does_not_end_is_text_below_the_table() {
    let table = |last: &str| ["id1,id2,force\n", &rows(",", ""), last].concat();
    let text = read(&Reader::new(), &table("\"made on Monday, or later\n"));
    assert!(text.comparison.accepted(1e-5));
    assert_eq!(text.rows.to_string(), "1 line of text (line 5)");
    // A row is not a row behind a quote.
    let named = "note,id1,id2,force\na,1,2,0.46225\na,1,3,0.46225\n\"a,1,4,0.46225\n";
    let line = refused(&Reader::new(), named);
    assert!(line.starts_with("line 4: a quote does not end"), "{line}");
    let line = refused(&Reader::new(), &table("\"made on,25,11\n"));
    assert!(line.starts_with("line 5: a quote does not end"), "{line}");
    assert!(
        line.ends_with("begin the line with # if it is not a row"),
        "{line}"
    );
}

#[test]
fn commas_that_may_separate_thousands_are_refused() {
    let table = |forces: [&str; 3]| {
        let [a, b, c] = forces;
        format!("id1\tid2\tforce\n1\t2\t{a}\n1\t3\t{b}\n1\t4\t{c}\n")
    };
    let unclear = ["5", "1,234", "12,345"];
    assert_eq!(
        refused(&Reader::new(), &table(unclear)),
        "line 3: the comma of '1,234' is a decimal sign or separates thousands: set decimal to comma, or leave out such commas"
    );
    let dialect = |decimal_comma| DialectOptions {
        decimal_comma: Some(decimal_comma),
        ..DialectOptions::default()
    };
    let given = |comma| Reader::new().with_dialect(dialect(comma));
    let error = read(&given(true), &table(unclear))
        .comparison
        .largest_error();
    assert!((error.unwrap() - (12.345 / 0.46225 - 1.0)).abs() < 1e-3);
    let line = refused(&given(false), &table(unclear));
    assert!(
        line.starts_with("line 3: force '1,234' is not a number"),
        "{line}"
    );
    // One number with other digits decides.
    for certain in ["0,462", "0,4622", "4,6e-1"] {
        let read = read(&Reader::new(), &table([certain, "1,234", "5"]));
        assert!(read.dialect.unwrap().decimal_comma, "{certain}");
    }
    let line = refused(&Reader::new(), &table(["0.46", "1,234", "5"]));
    assert!(
        line.starts_with("line 3: force '1,234' is not a number"),
        "{line}"
    );
}

#[test]
fn numbers_that_may_be_cut_at_decimal_commas_are_refused() {
    let numbered = Reader::new().with_columns(columns("id1=#1,id2=#2,force=#3"));
    for (force, said) in [("0,46", "'0,46'"), ("4,6e-1", "'4,6e-1'")] {
        let table = ["2", "3", "4"]
            .map(|id| format!("1,{id},{force}\n"))
            .concat();
        let line = refused(&numbered, &table);
        assert_eq!(
            line,
            format!(
                "line 1: {said} is two cells or one number with a decimal comma: set decimal to point, or separate cells by semicolons"
            )
        );
        let comma = DialectOptions {
            decimal_comma: Some(true),
            ..DialectOptions::default()
        };
        assert_eq!(refused(&numbered.clone().with_dialect(comma), &table), line);
        let point = DialectOptions {
            decimal_comma: Some(false),
            ..DialectOptions::default()
        };
        let read = read(&numbered.clone().with_dialect(point), &table);
        assert_eq!(read.comparison.matched(), 3);
    }
    // Numbers with decimals are not cut.
    let table = rows(",", ",7");
    assert!(read(&numbered, &table).comparison.accepted(1e-5));
}

#[test]
fn names_and_numbers_of_columns_may_be_mixed() {
    let columns = columns("id1=#3,id2=#4,force=#5,kind=type:SS,step=t");
    let reader = Reader::new().with_columns(columns);
    let rows = |step, force| {
        let row = |id| format!("SS,{step},1,{id},{force}\n");
        ["2", "3", "4"].map(row).concat() + &format!("SP,{step},4,0,1\n")
    };
    let table = ["type,t,a,b,f\n", &rows("0.1", "7"), &rows("0.2", "0.46225")].concat();
    let read = read(&reader, &table);
    assert!(read.comparison.accepted(1e-5));
    assert_eq!(
        (read.step.as_deref(), read.rows.other_kinds),
        (Some("0.2"), 1)
    );
}

#[test]
fn incomplete_vectors_and_centres_that_are_not_needed_are_not_read() {
    let table = "id1,id2,force,fx\n1,2,0.46225,x\n1,3,0.46225,x\n1,4,0.46225,x\n";
    assert!(read(&Reader::new(), table).comparison.accepted(1e-5));
    let mapped = Reader::new().with_columns(columns("fx=fx"));
    assert!(refused(&mapped, table).contains("no column fy"));
    let by_place = Reader::new().by_place(0.1).unwrap();
    let table = "x,y,z,force,x1\n-0.34641,-0.6,2.1633,0.46225,x\n-0.34641,0.6,2.1633,0.46225,x\n\
                 0.69282,0,2.1633,0.46225,x\n";
    assert!(read(&by_place, table).comparison.matched() == 3);
}

#[test]
fn columns_may_have_any_name_sign_factor_and_sum() {
    let reader = |text: &str| Reader::new().with_columns(columns(text));
    let by_name = reader("id1=A,id2=B,force=-1e3*Fn");
    let table = "n,A,Fn,B\n0,1,-0.00046225,2\n1,1,-0.00046225,3\n2,1,-0.00046225,4\n";
    assert!(read(&by_name, table).comparison.accepted(1e-5));
    let by_place = reader("id1=#2,id2=#4,force=#1-#3");
    let table = "0.5 1 0.03775 2\n0.5 1 0.03775 3\n0.5 1 0.03775 4\n";
    assert!(read(&by_place, table).comparison.accepted(1e-5));
    let sum = reader("force=normal+2*half");
    let table = "id1,id2,normal,half\n1,2,0.4,0.031125\n1,3,0.4,0.031125\n1,4,0.46225,0\n";
    assert!(read(&sum, table).comparison.accepted(1e-5));
    for (text, same) in [
        (
            "id1=A,fx=-f_x,fy=\"-f_y\"",
            "id1 = A, fx = -1*f_x, fy = 1*-f_y",
        ),
        ("force=-#3-#4+2.5*#5", "force=-1*#3+-1*#4+25e-1*#5"),
        (
            "force=a+-b,kind=type:0|1|SS",
            "force=a+-1*b,kind=type: 0 | 1 | SS",
        ),
    ] {
        assert_eq!(columns(text), columns(same), "{text}");
    }
}

#[test]
fn contacts_with_walls_are_counted_but_not_judged() {
    let reader = Reader::new().with_columns(columns("kind=t:SS|PP"));
    let table =
        "t,id1,id2,force\nSS,1,2,0.46225\nSM,9,0,-7\nPP,1,3,0.46225\nSS,1,4,0.46225\nSA,x,y,z\n";
    let read = read(&reader, table);
    assert_eq!(read.walls, 2);
    assert!(read.comparison.accepted(1e-5));
}

#[test]
fn spheres_may_be_numbered_from_any_first_id() {
    for (first, table) in [
        (0, "id1,id2,force\n0,1,0.46225\n0,2,0.46225\n3,0,0.46225\n"),
        (
            100,
            "id1,id2,force\n100,101,0.46225\n100,102,0.46225\n103,100,0.46225\n",
        ),
    ] {
        let reader = Reader::new().with_columns(Columns::default().with_first_id(first));
        assert!(read(&reader, table).comparison.accepted(1e-5));
    }
    let reader = Reader::new().with_columns(Columns::default().with_first_id(5));
    let line = refused(&reader, "id1,id2,force\n4,5,0.46\n");
    assert_eq!(
        line,
        "line 2: no sphere 4: the spheres of this scene are numbered 5 to 8, from the top; if the table counts from 4, use \
         --first-id 4"
    );
    // YADE counts from 0.
    let yade = Reader::of(Preset::Yade);
    assert!(
        read(
            &yade,
            "id1,id2,force\n0,1,0.46225\n0,2,0.46225\n0,3,0.46225\n"
        )
        .comparison
        .accepted(1e-5)
    );
}

#[test]
fn invalid_tables_are_rejected_with_a_remedy() {
    let named = Reader::new().with_columns(columns("id1=A"));
    assert_eq!(
        refused(&named, "id1,id2,force\n"),
        "line 1: no column 'A' for id1, only 'id1', 'id2', 'force': name one of these"
    );
    let numbered = Reader::new().with_columns(columns("id1=#1,id2=#2,force=#9"));
    assert_eq!(
        refused(&numbered, "1,2,3\n"),
        "line 1: no column #9 for force: the rows have 3 columns, and there is no header; does the table have another form?"
    );
    for text in [
        "",
        "A",
        "mass=A",
        "id1=",
        "id1=A,id1=B",
        "id1=-A",
        "id1=2*A",
        "id1=A+B",
        "id2=#1+#2",
        "id1=#0",
        "id1=#x",
        "force=\"A",
        "force=A\"B",
        "kind=type",
        "force=x*F",
        "force=0*F",
        "force=inf*F",
    ] {
        assert!(text.parse::<Columns>().is_err(), "{text:?}");
    }
}

#[test]
fn every_preset_reads_its_code_and_reports_a_wrong_force() {
    let pile = Pile::triangular(4).unwrap();
    let packing = packing(&pile, ratio(11, 10));
    let centres = centres(&packing).unwrap();
    for preset in Preset::ALL {
        let Some(head) = head(preset) else { continue };
        let mut reader = Reader::of(preset);
        if preset == Preset::Mddem {
            let spring = columns("force=1024*overlap");
            reader = reader.with_columns(preset.columns().overridden(&spring));
        }
        let mut measured = perfect(&packing);
        for swapped in measured.iter_mut().step_by(2) {
            *swapped = swapped.reversed();
        }
        let compare = |measured: &[Measured]| {
            let rows = measured.iter().map(|one| row(preset, one, &centres));
            let table = head.to_owned() + &rows.collect::<String>();
            reader.compare(&packing, table.as_bytes()).unwrap()
        };
        let read = compare(&measured);
        let comparison = &read.comparison;
        assert!(comparison.accepted(1e-12), "{preset}: {comparison}");
        assert_eq!(comparison.matched(), comparison.contacts(), "{preset}");
        assert_eq!(read.frame, None, "{preset}");
        let walls = matches!(preset, Preset::DemEngine | Preset::ExaDem);
        assert_eq!(read.walls, u64::from(walls), "{preset}");
        // One force is wrong.
        let wrong = &mut measured[7];
        wrong.force *= 1.001;
        wrong.vector = wrong.vector.map(|vector| vector.map(|x| x * 1.001));
        let [one, other] = wrong.ids;
        let comparison = compare(&measured).comparison;
        assert_eq!(comparison.beyond(1e-6), 1, "{preset}: {comparison}");
        let worst = comparison.worst().unwrap();
        assert_eq!(worst.ids, [one.min(other), one.max(other)], "{preset}");
    }
}
