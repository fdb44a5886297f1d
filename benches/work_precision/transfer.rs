//! The recursion from layer to layer, in any scalar and on any pile.

use cannonpile::Pile;
use cannonpile::scalar::Algebra;
use cannonpile::stacking::Sign;
use cannonpile::transfer::half_turn;

use crate::peers::network::Network;

/// All contact forces in f₀, three for each sphere above the floor: f = g + w, or G g + w where the stacking changes its
/// sign, with g from above and w = 1 the weight.
pub(crate) fn forces<T: Algebra>(pile: &Pile, network: &Network) -> Vec<[T; 3]> {
    let mut above = vec![[(); 3].map(|()| T::zero()); network.sites.len()];
    let mut forces = Vec::with_capacity(network.below.len());
    let one = T::one();
    let signs: Vec<Sign> = pile.shape().stacking().signs().collect();
    for (upper, below) in network.below.iter().enumerate() {
        let k = usize::try_from(network.sites[upper].k).expect("a layer");
        let received = above[upper].clone();
        let turned = if k > 0 && signs[k] != signs[k - 1] {
            half_turn(&received)
        } else {
            received
        };
        let passed_on = turned.map(|force| force + &one);
        for (direction, &lower) in below.iter().enumerate() {
            above[lower][direction] = passed_on[direction].clone();
        }
        forces.push(passed_on);
    }
    forces
}
