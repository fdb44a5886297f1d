//! Short arrays, element by element.

/// Applies a function to each element of a short array.
///
/// `<[T; N]>::map` does the same. It compiles to some 300 lines of LLVM IR a call, this one to 20.
pub(crate) trait Each<T> {
    /// The array of the same length, of `U`.
    type Of<U>;

    /// Returns the array of `f` of each element, in order.
    fn each<U>(self, f: impl FnMut(T) -> U) -> Self::Of<U>;
}

impl<T> Each<T> for [T; 2] {
    type Of<U> = [U; 2];

    fn each<U>(self, mut f: impl FnMut(T) -> U) -> [U; 2] {
        let [a, b] = self;
        [f(a), f(b)]
    }
}

impl<T> Each<T> for [T; 3] {
    type Of<U> = [U; 3];

    fn each<U>(self, mut f: impl FnMut(T) -> U) -> [U; 3] {
        let [a, b, c] = self;
        [f(a), f(b), f(c)]
    }
}
