//! Splitting of rows into parts for threads.

use alloc::boxed::Box;
use core::ops::Range;

use super::{Rows, Shape};
use crate::Error;
use crate::each::Each;
use crate::lattice::{Region, Row, Site};

/// A range of layers of a pile, or a region of one layer.
#[derive(Clone, Debug)]
pub(crate) enum Part<'p> {
    Layers(&'p Shape, Range<i128>),
    Layer(i128, Region),
}

/// A region is not split if the parallelogram of its ranges of i and j has at most this many sites.
const FEW: i128 = 256;

impl<'p> Part<'p> {
    /// Returns the remaining rows as a part: whole layers, or a single site.
    ///
    /// # Errors
    /// The errors of [`Region::new`], which do not occur for a site of a pile.
    pub(crate) fn of(rows: &Rows<'p>) -> Result<Self, Error> {
        Ok(match rows.one() {
            None => Self::Layers(rows.shape(), rows.layers()),
            Some(Site { i, j, k }) => Self::Layer(k, Region::new(i..=i, j..=j, i + j..=i + j)?),
        })
    }

    /// Returns both halves, in order. It splits layers if it can, else rows, else the sites of a row. A small region is
    /// returned whole, without a second half.
    pub(crate) fn halves(self) -> (Self, Option<Self>) {
        let middle = |start: i128, end: i128| start + (end - start) / 2;
        let (k, region) = match self {
            Self::Layers(shape, Range { start, end }) if end - start > 1 => {
                let middle = middle(start, end);
                let half = |layers| Self::Layers(shape, layers);
                return (half(start..middle), Some(half(middle..end)));
            }
            Self::Layers(shape, Range { start, end }) if start < end => match shape.layer(start) {
                Ok(region) => (start, region),
                Err(_) => return (self, None),
            },
            Self::Layers(..) => return (self, None),
            Self::Layer(k, region) => (k, region),
        };
        let ([x, y], s) = ([region.x(), region.y()], region.s());
        let [width, height] = [&x, &y].each(|side| side.end() - side.start() + 1);
        if width.saturating_mul(height) <= FEW {
            return (Self::Layer(k, region), None);
        }
        let cut = |side: &core::ops::RangeInclusive<i128>| {
            let last = middle(*side.start(), *side.end());
            [*side.start()..=last, last + 1..=*side.end()]
        };
        let halves = if height > 1 {
            cut(&y).each(|y| Region::new(x.clone(), y, s.clone()))
        } else {
            cut(&x).each(|x| Region::new(x, y.clone(), s.clone()))
        };
        match halves {
            [Ok(before), Ok(behind)] => (Self::Layer(k, before), Some(Self::Layer(k, behind))),
            _ => (Self::Layer(k, region), None),
        }
    }

    /// Returns the rows, from the top.
    pub(crate) fn rows(self) -> Box<dyn Iterator<Item = Row> + Send + 'p> {
        match self {
            Self::Layers(shape, layers) => Box::new(Rows::of_layers(shape, layers)),
            Self::Layer(k, region) => Box::new(region.rows(k)),
        }
    }
}

#[cfg(test)]
mod tests {
    use alloc::vec::Vec;

    use super::*;
    use crate::lattice::Dimension;
    use crate::shape::Selection;

    /// Splits recursively. Returns the sites of all parts in order, and the number of parts.
    fn split(part: Part<'_>) -> (Vec<Site>, usize) {
        match part.halves() {
            (before, Some(behind)) => {
                let ((mut sites, parts), (others, further)) = (split(before), split(behind));
                sites.extend(others);
                (sites, parts + further)
            }
            (part, None) => (part.rows().flatten().collect(), 1),
        }
    }

    #[test]
    fn parts_have_all_rows_in_order() {
        let hexagon = Region::hexagon(20, 25).unwrap();
        for shape in [
            Shape::pyramid(40, Dimension::Three).unwrap(),
            Shape::pyramid(1000, Dimension::Two).unwrap(),
            Shape::under(hexagon, "++-".parse().unwrap()).unwrap(),
        ] {
            let site = shape.sites().nth(100).unwrap();
            for (part, most) in [
                (Selection::All, usize::MAX),
                (Selection::Base, usize::MAX),
                (Selection::One(site), 1),
            ] {
                let none = shape.rows(Selection::Base).unwrap().off_the_floor();
                assert_eq!(split(Part::of(&none).unwrap()), (Vec::new(), 1));
                let rows = shape.rows(part).unwrap();
                let (sites, parts) = split(Part::of(&rows).unwrap());
                assert!(rows.sites().eq(sites));
                assert!(
                    (most > 1) == (parts > 1) && parts <= most,
                    "{part:?}: {parts}"
                );
            }
        }
    }
}
