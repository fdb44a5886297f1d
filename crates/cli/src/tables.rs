//! Tables of the command line: bounds, stability, responses, sensitivity, the census, random stackings, theorems, cases, plans.

mod bounds;
mod cases;
mod census;
mod disorder;
mod ensemble;
mod explain;
mod response;
mod sensitivity;
mod stability;
mod theorems;

pub(crate) use bounds::{bounds, bounds_of};
pub(crate) use cases::cases;
pub(crate) use census::{census, horizontal_census};
pub(crate) use disorder::{by_faults, mean, mean_of_polynomials};
pub(crate) use ensemble::{ensemble, ensemble_summary, histogram};
pub(crate) use explain::{Explanation, Wanted, Work};
pub(crate) use response::response;
pub(crate) use sensitivity::{sensitivity, spread};
pub(crate) use stability::{margin, polygon};
pub(crate) use theorems::{in_coq, theorems};

#[cfg(test)]
mod test {
    //! Functions that the tests of all tables share.

    use cannonpile_dem::table::{FileFormat, NumberFormat, Table};
    use num_rational::BigRational;

    pub(super) fn ratio(n: i64, d: i64) -> BigRational {
        BigRational::new(n.into(), d.into())
    }

    /// Returns the table as csv, in exact numbers.
    pub(super) fn csv(table: Table<'_>) -> String {
        let mut csv = Vec::new();
        let written = table.write(FileFormat::Csv, NumberFormat::Exact, &mut csv);
        written.expect("a table in memory");
        String::from_utf8(csv).expect("text")
    }
}
