//! A map in one sorted vector, and lists without repetitions.

use alloc::vec::Vec;
use core::cmp::Ordering;
use core::ops::{Deref, Range};

/// A map whose entries are in one vector, in the order of their keys.
///
/// Most maps of this crate are built once and then read. Each kind of `BTreeMap` compiles to some 8,000 lines of LLVM
/// IR, this to a tenth, and the crate has a dozen kinds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Sorted<K, V>(Vec<(K, V)>);

impl<K: Ord, V> Sorted<K, V> {
    pub(crate) const fn new() -> Self {
        Self(Vec::new())
    }

    /// Inserts entries in any order. `add` combines the value of a key with a further value of the same key.
    pub(crate) fn merge(&mut self, entries: Vec<(K, V)>, add: impl Fn(&mut V, &V)) {
        self.0.extend(entries);
        sort(&mut self.0, |(one, _), (other, _)| one.cmp(other));
        self.0.dedup_by(|(key, value), (kept, sum)| {
            let same = key == kept;
            if same {
                add(sum, value);
            }
            same
        });
    }

    /// Returns the value of a key, after the insertion of `default` if it has none. An insertion moves all later
    /// entries.
    pub(crate) fn entry(&mut self, key: K, default: V) -> &mut V {
        let place = match self.place(&key) {
            Ok(place) => place,
            Err(place) => {
                self.0.insert(place, (key, default));
                place
            }
        };
        &mut self.0[place].1
    }

    pub(crate) fn get(&self, key: &K) -> Option<&V> {
        self.place(key).ok().map(|place| &self.0[place].1)
    }

    /// Returns the entries with the keys of a range, in order. `range` must not end before it starts.
    pub(crate) fn range(&self, range: &Range<K>) -> &[(K, V)] {
        let place = |key| self.0.partition_point(|(other, _)| other < key);
        &self.0[place(&range.start)..place(&range.end)]
    }

    pub(crate) fn values_mut(&mut self) -> impl Iterator<Item = &mut V> {
        self.0.iter_mut().map(|(_, value)| value)
    }

    /// Removes the entries whose value does not pass the test.
    pub(crate) fn retain(&mut self, keep: impl Fn(&V) -> bool) {
        self.0.retain(|(_, value)| keep(value));
    }

    pub(crate) fn into_vec(self) -> Vec<(K, V)> {
        self.0
    }

    /// Returns the index of the entry of a key, or the index at which it would stand.
    pub(crate) fn place(&self, key: &K) -> Result<usize, usize> {
        self.0.binary_search_by(|(other, _)| other.cmp(key))
    }
}

impl<K, V> Deref for Sorted<K, V> {
    type Target = [(K, V)];

    fn deref(&self) -> &[(K, V)] {
        &self.0
    }
}

/// Sorts a list and removes repetitions.
pub(crate) fn distinct<T: Ord>(mut list: Vec<T>) -> Vec<T> {
    sort(&mut list, T::cmp);
    list.dedup();
    list
}

/// Sorts a list. Equal entries keep their order.
///
/// Lists of all types share one sort of indices: a sort of the standard library compiles to some 2,000 lines of LLVM IR.
fn sort<T>(list: &mut [T], compare: impl Fn(&T, &T) -> Ordering) {
    let mut order = order(list.len(), &|one, other| compare(&list[one], &list[other]));
    // Each cycle of the permutation is done by swaps.
    for start in 0..list.len() {
        let mut place = start;
        while order[place] != start {
            let from = order[place];
            list.swap(place, from);
            order[place] = place;
            place = from;
        }
        order[place] = place;
    }
}

/// Returns the indices below `count` in the order of `compare`.
fn order(count: usize, compare: &dyn Fn(usize, usize) -> Ordering) -> Vec<usize> {
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|one, other| compare(*one, *other));
    order
}

#[cfg(test)]
mod tests {
    use alloc::vec;

    use super::*;

    #[test]
    fn entries_are_in_order_and_equal_keys_are_merged() {
        let mut map = Sorted::new();
        map.merge(vec![(3, 1), (1, 10), (3, 2)], |sum, value| *sum += value);
        *map.entry(2, 0) += 7;
        map.merge(vec![(1, 5)], |sum, value| *sum += value);
        assert_eq!(*map, [(1, 15), (2, 7), (3, 3)]);
        assert_eq!(map.range(&(2..4)), [(2, 7), (3, 3)]);
        assert_eq!(map.range(&(2..2)), []);
        assert_eq!((map.get(&2), map.get(&4)), (Some(&7), None));
        map.retain(|value| *value != 7);
        assert!(map.get(&2).is_none());
        assert_eq!(map.into_vec(), [(1, 15), (3, 3)]);
    }
    #[test]
    fn equal_entries_keep_their_order() {
        for number in 0..3_u32.pow(7) {
            let digit = |place| (number / 3_u32.pow(place) % 3, place);
            let mut list: Vec<_> = (0..7).map(digit).collect();
            let mut expected = list.clone();
            expected.sort_unstable();
            sort(&mut list, |one, other| one.0.cmp(&other.0));
            assert_eq!(list, expected);
        }
        assert_eq!(distinct(vec![2, 1, 2, 3, 1]), [1, 2, 3]);
    }
}
