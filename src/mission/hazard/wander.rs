//! A quantity that fluctuates randomly about zero: a first-order Gauss-Markov process.

use crate::geo::maths;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

#[derive(Debug, Clone)]
pub(super) struct Wander {
    pub value: f64,
    spread: f64,
    tau_s: f64,
}

impl Wander {
    /// A process in its steady state.
    pub fn new(spread: f64, tau_s: f64, random: &mut ChaCha8Rng) -> Self {
        let start: f64 = StandardNormal.sample(random);
        Self {
            value: spread * start,
            spread,
            tau_s,
        }
    }

    /// Advances time; the result is exact for any step.
    pub fn step(&mut self, dt_s: f64, random: &mut ChaCha8Rng) {
        let kept = maths::exp(-dt_s / self.tau_s);
        let push: f64 = StandardNormal.sample(random);
        self.value = kept * self.value + self.spread * (1.0 - kept * kept).sqrt() * push;
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;

    use super::*;

    #[test]
    fn it_spreads_as_asked_and_forgets_in_its_time() {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let mut wander = Wander::new(2.0, 5.0, &mut random);
        let series: Vec<f64> = (0..200_000)
            .map(|_| {
                wander.step(1.0, &mut random);
                wander.value
            })
            .collect();
        let mean_product = |lag: usize| {
            let products = series.iter().zip(&series[lag..]).map(|(a, b)| a * b);
            products.sum::<f64>() / (series.len() - lag) as f64
        };
        assert!((mean_product(0).sqrt() - 2.0).abs() < 0.05);
        let share = mean_product(5) / mean_product(0);
        assert!((share - maths::exp(-1.0_f64)).abs() < 0.03, "{share}");
    }
}
