//! The square roots of a packing, each taken when it is first needed.

use alloc::boxed::Box;

use num_rational::BigRational;
use num_traits::One;
use once_cell::race::OnceBox;

use super::Packing;
use crate::geometry::Inclination;
use crate::meter::Meter;
use crate::scalar::{Ring, Surd};

/// A square root that is taken once.
#[derive(Debug)]
struct Root {
    square: BigRational,
    taken: OnceBox<Surd>,
}

impl Root {
    fn of(square: BigRational) -> Self {
        Self {
            square,
            taken: OnceBox::new(),
        }
    }

    fn get(&self, meter: impl Meter) -> &Surd {
        self.taken.get_or_init(|| {
            meter.take_root();
            // Squares of sines and cosines are not negative.
            let root = Surd::sqrt(self.square.clone());
            Box::new(root.unwrap_or_else(|_| Surd::zero()))
        })
    }
}

impl Clone for Root {
    fn clone(&self) -> Self {
        Self {
            square: self.square.clone(),
            taken: clone(&self.taken),
        }
    }
}

fn clone(once: &OnceBox<Surd>) -> OnceBox<Surd> {
    let copy = OnceBox::new();
    if let Some(value) = once.get() {
        // Nobody else has the copy yet.
        let _ = copy.set(Box::new(value.clone()));
    }
    copy
}

/// What geometry brings into answers, beside rational factors.
#[derive(Debug)]
pub(super) struct Roots {
    sin: Root,
    cos: Root,
    tan: Root,
    secant: Root,
    twice_cos_phi: Root,
    /// 2cosφ·sinθ and 2cosφ·tanθ.
    across: [OnceBox<Surd>; 2],
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
            across: [OnceBox::new(), OnceBox::new()],
            one: BigRational::one().into(),
        }
    }
}

impl Clone for Roots {
    fn clone(&self) -> Self {
        Self {
            sin: self.sin.clone(),
            cos: self.cos.clone(),
            tan: self.tan.clone(),
            secant: self.secant.clone(),
            twice_cos_phi: self.twice_cos_phi.clone(),
            across: self.across.each_ref().map(clone),
            one: self.one.clone(),
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
        let across = across.get_or_init(|| Box::new(sin.clone() * roots.twice_cos_phi.get(meter)));
        [sin, across, roots.cos.get(meter)]
    }

    /// (tanθ, 2cosφ·tanθ, 1): the symbolic basis over cosθ.
    pub(super) fn forces(&self) -> [&Surd; 3] {
        let (meter, roots) = (self.meter(), &self.roots);
        let tan = roots.tan.get(meter);
        let [_, across] = &roots.across;
        let across = across.get_or_init(|| Box::new(tan.clone() * roots.twice_cos_phi.get(meter)));
        [tan, across, &roots.one]
    }
}
