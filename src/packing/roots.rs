//! The square roots of a packing, each taken when it is first needed.

use alloc::boxed::Box;

use num_rational::BigRational;
use num_traits::One;
use once_cell::race::OnceBox;

use super::Packing;
use crate::geometry::Inclination;
use crate::meter::Meter;
use crate::scalar::{Ring, Surd};

/// A number that is found when it is first needed.
#[derive(Debug, Default)]
pub(super) struct Once(OnceBox<Surd>);

impl Once {
    pub(super) fn get(&self, find: impl FnOnce() -> Surd) -> &Surd {
        self.0.get_or_init(|| Box::new(find()))
    }
}

impl Clone for Once {
    fn clone(&self) -> Self {
        let copy = OnceBox::new();
        if let Some(value) = self.0.get() {
            // Nobody else has the copy yet.
            let _ = copy.set(Box::new(value.clone()));
        }
        Self(copy)
    }
}

/// A square root that is taken once.
#[derive(Clone, Debug)]
struct Root {
    square: BigRational,
    taken: Once,
}

impl Root {
    fn of(square: BigRational) -> Self {
        Self {
            square,
            taken: Once::default(),
        }
    }

    fn get(&self, meter: impl Meter) -> &Surd {
        self.taken.get(|| {
            meter.take_root();
            // Squares of sines and cosines are not negative.
            Surd::sqrt(self.square.clone()).unwrap_or_else(|_| Surd::zero())
        })
    }
}

/// What geometry brings into answers, beside rational factors.
#[derive(Clone, Debug)]
pub(super) struct Roots {
    sin: Root,
    cos: Root,
    tan: Root,
    secant: Root,
    twice_cos_phi: Root,
    /// 2cosφ·sinθ and 2cosφ·tanθ.
    across: [Once; 2],
    one: Surd,
}

impl Roots {
    pub(super) fn new(inclination: &Inclination, sin_phi: &BigRational) -> Self {
        let cos2_phi = BigRational::one() - sin_phi * sin_phi;
        Self {
            sin: Root::of(inclination.sin2().clone()),
            cos: Root::of(inclination.cos2()),
            tan: Root::of(inclination.tan2()),
            secant: Root::of(inclination.cos2().recip()),
            twice_cos_phi: Root::of(BigRational::from_i128(4) * cos2_phi),
            across: [Once::default(), Once::default()],
            one: BigRational::one().into(),
        }
    }
}

impl<M: Meter> Packing<'_, M> {
    fn meter(&self) -> M {
        self.statics.meter()
    }

    /// 1/cosθ.
    pub(super) fn secant(&self) -> &Surd {
        self.roots.secant.get(self.meter())
    }

    /// (sinθ, 2cosφ·sinθ, cosθ).
    pub(super) fn lengths(&self) -> [&Surd; 3] {
        let (meter, roots) = (self.meter(), &self.roots);
        let sin = roots.sin.get(meter);
        let [across, _] = &roots.across;
        let across = across.get(|| sin.clone() * roots.twice_cos_phi.get(meter));
        [sin, across, roots.cos.get(meter)]
    }

    /// (tanθ, 2cosφ·tanθ, 1): the symbolic basis over cosθ.
    pub(super) fn forces(&self) -> [&Surd; 3] {
        let (meter, roots) = (self.meter(), &self.roots);
        let tan = roots.tan.get(meter);
        let [_, across] = &roots.across;
        let across = across.get(|| tan.clone() * roots.twice_cos_phi.get(meter));
        [tan, across, &roots.one]
    }
}
