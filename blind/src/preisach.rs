//! This file is the Preisach operator with even density over the triangle 0 ≤ β ≤ α ≤ 1 (Preisach 1935, Mayergoyz 1986).
//!
//! Relays switch up at α and down at β. With even density the output from 0 is the input's square going up, and each turn
//! adds or takes the square of its swing: only the turning points that later swings have not passed count.

/// The turning points in force, a maximum and a minimum in turn, each swing smaller than the one before.
#[derive(Clone, Debug)]
pub struct Preisach {
    turns: Vec<f64>,
    input: f64,
}

impl Preisach {
    /// Every relay down.
    pub const fn new() -> Preisach {
        Preisach {
            turns: Vec::new(),
            input: 0.0,
        }
    }

    /// Takes an input between 0 and 1.
    pub fn take(&mut self, input: f64) {
        let input = input.clamp(0.0, 1.0);
        let rises = input > self.input;
        if input == self.input {
            return;
        }
        // An even count of turns means that the input was rising: the next turn is a maximum.
        let was_rising = self.turns.len().is_multiple_of(2);
        if rises != was_rising {
            self.turns.push(self.input);
        }
        // A swing that passes an older turn wipes it and its successor out.
        while let [.., older, _] = self.turns.as_slice() {
            let passed = if rises {
                input >= *older
            } else {
                input <= *older
            };
            if !passed {
                break;
            }
            self.turns.truncate(self.turns.len() - 2);
        }
        if !rises && input <= 0.0 {
            self.turns.clear();
        }
        self.input = input;
    }

    /// The share of the relays that are up.
    pub fn output(&self) -> f64 {
        let mut last = 0.0;
        let mut sign = 1.0;
        let mut sum = 0.0;
        for turn in self.turns.iter().chain(std::iter::once(&self.input)) {
            let swing = turn - last;
            sum += sign * swing * swing;
            sign = -sign;
            last = *turn;
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A grid of relays, one by one.
    fn relays(inputs: &[f64], n: usize) -> f64 {
        let cell = |k: usize| (k as f64 + 0.5) / n as f64;
        let mut up = vec![false; n * n];
        for input in inputs {
            for a in 0..n {
                for b in 0..=a {
                    if *input >= cell(a) {
                        up[a * n + b] = true;
                    } else if *input < cell(b) {
                        up[a * n + b] = false;
                    }
                }
            }
        }
        let count = up.iter().filter(|x| **x).count();
        count as f64 / (n * (n + 1) / 2) as f64
    }

    #[test]
    fn the_turning_points_count_what_single_relays_do() {
        let inputs = [
            0.31, 0.83, 0.42, 0.57, 0.49, 0.71, 0.13, 0.92, 0.07, 0.36, 0.21, 0.29, 0.97, 0.61,
            0.0, 0.44,
        ];
        for count in 1..=inputs.len() {
            let mut operator = Preisach::new();
            inputs[..count].iter().for_each(|x| operator.take(*x));
            let counted = relays(&inputs[..count], 400);
            assert!(
                (operator.output() - counted).abs() < 6e-3,
                "{count}: {} {counted}",
                operator.output()
            );
        }
    }

    #[test]
    fn minor_steps_on_the_way_leave_nothing_behind() {
        let (mut straight, mut stepped) = (Preisach::new(), Preisach::new());
        [0.9, 0.2, 0.7].iter().for_each(|x| straight.take(*x));
        [0.3, 0.5, 0.4, 0.9, 0.6, 0.8, 0.2, 0.3, 0.7]
            .iter()
            .for_each(|x| stepped.take(*x));
        assert!((straight.output() - stepped.output()).abs() < 1e-15);
    }
}
