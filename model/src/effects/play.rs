//! This file is the play that a brake's current moves: what stays of the current that was.

/// Plays that stand for many of unlike widths.
pub const PLAYS: usize = 4;

/// A play operator whose sides come together towards no current (a generalised play: Visintin, Differential Models of Hysteresis, 1994), or the mean of many
/// plays of unlike widths (Prandtl and Ishlinskii; Krejčí, Hysteresis, Convexity and Dissipation in Hyperbolic Equations, 1996).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurrentPlay {
    /// How far the widest play stays behind the current on either side, A; above 0.
    pub half_width_a: f64,
    /// The current below which the sides come together, A: none of it stays where no current flows. 0 for sides that do not.
    pub closing_a: f64,
    /// How far down the half widths are spread evenly, as a share of the widest: 0 for a single play, 1 for plays of every width from none on.
    pub spread: f64,
    /// The current at which the play, that rose from none, holds all of it, A: there a table was taken. 0 where what it is short of is short everywhere.
    pub top_a: f64,
}

/// Where plays of unlike widths stand, A; all of them at no current before any flowed.
pub type Played = [f64; PLAYS];

impl CurrentPlay {
    /// Where the plays stand that stood at `played` before the current came to `current_a`.
    pub fn moved(&self, mut played: Played, current_a: f64) -> Played {
        let open = if current_a < self.closing_a {
            (current_a / self.closing_a).max(0.0)
        } else {
            1.0
        };
        for (k, play_a) in played.iter_mut().enumerate() {
            // Each stands for a part of the widths of equal size, by its middle.
            let narrower = self.spread * (k as f64 + 0.5) / PLAYS as f64;
            let half_a = open * self.half_width_a * (1.0 - narrower);
            *play_a = play_a.clamp(current_a - half_a, current_a + half_a);
        }
        played
    }

    /// The current that plays which stand there hold together, A.
    pub fn held_a(&self, played: &Played) -> f64 {
        let held_a = played.iter().sum::<f64>() / PLAYS as f64;
        let short_a = self.half_width_a * (1.0 - 0.5 * self.spread);
        match self.top_a > short_a {
            true => held_a * self.top_a / (self.top_a - short_a),
            false => held_a,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const OPEN: CurrentPlay = CurrentPlay {
        half_width_a: 0.07,
        closing_a: 0.0,
        spread: 0.0,
        top_a: 0.0,
    };

    #[test]
    fn a_play_stays_behind_on_both_ways_and_closes_only_where_its_sides_do() {
        let closing = CurrentPlay {
            closing_a: 0.4,
            ..OPEN
        };
        for (play, at_rest) in [(OPEN, 0.07), (closing, 0.0)] {
            let up = play.moved([0.0; PLAYS], 0.53);
            assert!((play.held_a(&up) - 0.46).abs() < 1e-12, "{up:?}");
            assert_eq!(play.moved(up, 0.41), up);
            let down = play.moved(up, 0.31);
            let half = if play == OPEN {
                0.07
            } else {
                0.07 * 0.31 / 0.4
            };
            assert!(
                (play.held_a(&down) - (0.31 + half)).abs() < 1e-12,
                "{down:?}"
            );
            let gone = play.moved(down, 0.0);
            assert!((play.held_a(&gone) - at_rest).abs() < 1e-12, "{gone:?}");
        }
    }

    #[test]
    fn plays_of_every_width_come_back_bit_by_bit() {
        let spread = CurrentPlay {
            half_width_a: 0.1,
            spread: 1.0,
            ..OPEN
        };
        let up = spread.moved([0.0; PLAYS], 0.5);
        // The mean half width of plays of every width is half of the widest.
        assert!((spread.held_a(&up) - 0.45).abs() < 1e-12, "{up:?}");
        // After a turn the narrow ones move first: with a lag that grows with the square of the way back.
        let back = |by_a: f64| spread.held_a(&up) - spread.held_a(&spread.moved(up, 0.5 - by_a));
        let ways = [0.05, 0.1, 0.15, 0.2].map(back);
        assert!(ways[0] > 0.0 && ways.windows(2).all(|w| w[1] - w[0] > 0.0));
        assert!(ways[3] - ways[2] > ways[1] - ways[0], "{ways:?}");
        assert!((back(0.3) - 0.2).abs() < 1e-12);
    }

    #[test]
    fn a_play_that_meets_the_table_at_its_top_holds_all_there() {
        for spread in [0.0, 0.4, 1.0] {
            let play = CurrentPlay {
                half_width_a: 0.2,
                spread,
                top_a: 0.9,
                ..OPEN
            };
            let at = |current_a: f64| play.held_a(&play.moved([0.0; PLAYS], current_a));
            assert!((at(0.9) - 0.9).abs() < 1e-12, "{}", at(0.9));
            assert!(at(0.5) < 0.5);
        }
    }
}
