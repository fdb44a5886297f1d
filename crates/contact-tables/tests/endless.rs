//! Input without end is refused at the first row beyond the limit, with the limit and a remedy.

use std::io::{self, BufReader, Read};

use contact_tables::{Columns, Contact, Format};

/// Text in which one part is repeated without end.
struct Endless {
    begin: &'static [u8],
    again: &'static [u8],
}

impl Read for Endless {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if self.begin.is_empty() {
            self.begin = self.again;
        }
        self.begin.read(buffer)
    }
}

#[test]
fn the_first_row_beyond_the_limit_is_refused() {
    let said = "more than 1000 rows, the most that are read: leave out pairs that do not touch, or name the column of the \
                steps with step=COLUMN";
    let cases: [(&str, &[u8], &[u8], u64); 4] = [
        ("rows", b"id1,id2,force\n", b"1,2,0.5\n", 1002),
        ("one step", b"step,id1,id2,force\n", b"7,1,2,0.5\n", 1002),
        (
            "the second step",
            b"step,id1,id2,force\n6,1,2,0.5\n",
            b"7,1,2,0.5\n",
            1003,
        ),
        (
            "a dump",
            b"ITEM: TIMESTEP\n7\nITEM: NUMBER OF ENTRIES\n18446744073709551615\nITEM: ENTRIES id1 id2 force\n",
            b"1 2 0.5\n",
            1006,
        ),
    ];
    for (case, begin, again, line) in cases {
        let format = Format {
            most_rows: Some(1000),
            ..Format::of(Columns::default())
        };
        let input = BufReader::new(Endless { begin, again });
        let mut read = Vec::new();
        let mut refused = None;
        for row in contact_tables::read(input, &format).unwrap() {
            match row {
                Ok(row) => read.push(row),
                Err(error) => refused = Some(error.to_string()),
            }
        }
        assert_eq!(read.len(), 1000, "{case}");
        assert_eq!(refused, Some(format!("line {line}: {said}")), "{case}");
    }
}

#[test]
fn rows_up_to_the_limit_are_read_in_each_step() {
    let table = "step,id1,id2,force\n1,1,2,0.5\n1,1,3,0.5\n2,1,2,0.5\n2,1,3,0.5\n";
    let format = Format {
        most_rows: Some(2),
        ..Format::default()
    };
    let read = contact_tables::read(table.as_bytes(), &format).unwrap();
    let rows: Result<Vec<Contact>, _> = read.collect();
    assert_eq!(rows.unwrap().len(), 2);
}
