//! This file fits the torque gain (3.3) and the time constant surfaces (3.5), (3.6) to many steps.

use rigproof_spec::tables::{Edge, GAIN_BREAK_A};

use super::least_squares::{Estimate, Row, least_squares};

/// Currents closer than this to the break of (3.3) count as the break, A.
const AT_BREAK_A: f64 = 1e-3;

/// The coefficients of (3.3).
#[derive(Clone, Debug, PartialEq)]
pub struct GainFit {
    /// k1, N·m/A, and k2, N·m.
    pub linear: [Estimate; 2],
    /// k3, N·m/A², k4, N·m/A, and k5, N·m.
    pub quadratic: [Estimate; 3],
    /// Coefficient of determination over all measurements.
    pub r_squared: f64,
    /// Whether the linear piece had to take the break itself, as the thesis's own currents did.
    pub break_in_linear: bool,
}

/// Least-squares fit of (3.3) to steady torques: `(current, A; torque, N·m; group of one current)`.
///
/// The quadratic piece takes the currents from 0.2 A. The linear piece takes those below; if only one of these was
/// measured, as in the thesis, 0.2 A as well (gap `gain-low-current`). `None` when the currents do not determine it.
pub fn gain_fit(steady: &[(f64, f64, usize)]) -> Option<GainFit> {
    let above = |current_a: f64| current_a > GAIN_BREAK_A - AT_BREAK_A;
    let at_break = |current_a: f64| (current_a - GAIN_BREAK_A).abs() < AT_BREAK_A;
    let quadratic: Vec<Row<3>> = steady
        .iter()
        .filter(|(current_a, ..)| above(*current_a))
        .map(|&(i, value, group)| row([i * i, i, 1.0], value, group))
        .collect();
    let low: Vec<Row<2>> = steady
        .iter()
        .filter(|(current_a, ..)| !above(*current_a))
        .map(|&(i, value, group)| row([i, 1.0], value, group))
        .collect();
    let alone = least_squares(&low);
    let break_in_linear = alone.is_none();
    let linear = alone.or_else(|| {
        let breaks = steady.iter().filter(|(i, ..)| at_break(*i));
        let breaks = breaks.map(|&(i, value, group)| row([i, 1.0], value, group));
        let mut rows = low.clone();
        rows.extend(breaks);
        least_squares(&rows)
    })?;
    let curve = least_squares(&quadratic)?;
    let below = low
        .iter()
        .map(|r| r.value)
        .zip(linear.fitted.iter().copied());
    let beyond = quadratic
        .iter()
        .map(|r| r.value)
        .zip(curve.fitted.iter().copied());
    let pairs: Vec<(f64, f64)> = below.chain(beyond).collect();
    Some(GainFit {
        linear: linear.unknowns,
        quadratic: curve.unknowns,
        r_squared: r_squared(&pairs),
        break_in_linear,
    })
}

/// The coefficients of (3.5) or (3.6).
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceFit {
    /// a1 … a6.
    pub coefficients: [Estimate; 6],
    /// Coefficient of determination over the measurements that were fitted.
    pub r_squared: f64,
    /// Whether the fit had to take the threshold itself, as the thesis's falling one must have.
    pub with_threshold: bool,
}

/// Least-squares fit of (3.5) or (3.6) to time constants: `(current, A; speed, rpm; time constant, s)`.
///
/// The surface takes the speeds below the threshold; if these are fewer than three, the threshold as well: with two speeds
/// ω_L and ω_L² cannot be told apart (gap `surface-threshold`). The scatter is taken to grow in proportion to the time
/// constant. `None` when the measurements do not determine it.
//= thesis (3.5)
//= thesis (3.6)
pub fn surface_fit(measured: &[(f64, f64, f64)], edge: Edge) -> Option<SurfaceFit> {
    let threshold_rpm = edge.threshold_rpm();
    let up_to = |greatest_rpm: f64| -> Vec<(f64, f64, f64)> {
        let low = measured
            .iter()
            .filter(|(_, omega, _)| *omega < greatest_rpm);
        low.copied().collect()
    };
    let below = up_to(threshold_rpm * (1.0 - AT_THRESHOLD));
    let enough = distinct_speeds(&below) > 2;
    match surface_of(&below).filter(|_| enough) {
        Some(fit) => Some(fit),
        None => {
            let with_threshold = up_to(threshold_rpm * (1.0 + AT_THRESHOLD));
            let enough = distinct_speeds(&with_threshold) > 2;
            surface_of(&with_threshold)
                .filter(|_| enough)
                .map(|fit| SurfaceFit {
                    with_threshold: true,
                    ..fit
                })
        }
    }
}

/// Share of the threshold within which a speed counts as the threshold.
const AT_THRESHOLD: f64 = 0.05;

/// How many speeds there are; two that are closer than 10 % are one that was measured twice.
fn distinct_speeds(measured: &[(f64, f64, f64)]) -> usize {
    let mut speeds: Vec<f64> = measured.iter().map(|m| m.1).collect();
    speeds.sort_by(f64::total_cmp);
    let mut before = 0.0;
    let mut count = 0;
    for speed in speeds {
        if speed > 1.1 * before {
            count += 1;
        }
        before = speed;
    }
    count
}

fn surface_of(measured: &[(f64, f64, f64)]) -> Option<SurfaceFit> {
    let rows = |spread: &dyn Fn(usize) -> f64| -> Vec<Row<6>> {
        let numbered = measured.iter().enumerate();
        numbered
            .map(|(index, &(i, omega_rpm, value))| {
                let l = libm::log2(omega_rpm);
                Row {
                    terms: [i, l, i * l, l * l, i * l * l, 1.0],
                    value,
                    group: 0,
                    spread: spread(index),
                }
            })
            .collect()
    };
    let first = least_squares(&rows(&|_| 1.0))?;
    let least = first
        .fitted
        .iter()
        .copied()
        .filter(|a| *a > 0.0)
        .fold(f64::INFINITY, f64::min);
    let fitted = first.fitted.clone();
    let fit = least_squares(&rows(&|index| {
        fitted.get(index).copied().unwrap_or(least).max(least)
    }))?;
    let values = measured.iter().map(|m| m.2);
    let pairs: Vec<(f64, f64)> = values.zip(fit.fitted.iter().copied()).collect();
    Some(SurfaceFit {
        coefficients: fit.unknowns,
        r_squared: r_squared(&pairs),
        with_threshold: false,
    })
}

/// The mean of numbers that scatter alike; `None` of none.
pub fn average(values: &[f64]) -> Option<Estimate> {
    let rows: Vec<Row<1>> = values.iter().map(|&value| row([1.0], value, 0)).collect();
    let [mean] = least_squares(&rows)?.unknowns;
    Some(mean)
}

const fn row<const P: usize>(terms: [f64; P], value: f64, group: usize) -> Row<P> {
    Row {
        terms,
        value,
        group,
        spread: 1.0,
    }
}

/// One less the share of the scatter about the mean that the fit leaves.
fn r_squared(pairs: &[(f64, f64)]) -> f64 {
    let mean = pairs.iter().map(|(value, _)| value).sum::<f64>() / pairs.len() as f64;
    let square = |x: f64| x * x;
    let left: f64 = pairs
        .iter()
        .map(|(value, fitted)| square(value - fitted))
        .sum();
    let total: f64 = pairs.iter().map(|(value, _)| square(value - mean)).sum();
    1.0 - left / total
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::brake::{time_constant, torque_gain};
    use rigproof_spec::joint::Joint;
    use rigproof_spec::tables::{time_constant_fit, torque_gain_fit};
    use rigproof_spec::units::rad_s_from_rpm;

    #[test]
    fn exact_torques_give_back_table_3_2() {
        for joint in Joint::ALL {
            let currents = [0.0, 0.11, 0.17, 0.23, 0.41, 0.63, 0.79, 0.97];
            let steady: Vec<(f64, f64, usize)> = currents
                .into_iter()
                .enumerate()
                .map(|(group, i)| (i, torque_gain(joint, i), group))
                .collect();
            let fit = gain_fit(&steady).unwrap();
            let table = torque_gain_fit(joint);
            let found = [fit.linear.as_slice(), &fit.quadratic].concat();
            let printed = [table.k_1, table.k_2, table.k_3, table.k_4, table.k_5];
            for (found, printed) in found.iter().zip(printed) {
                assert!(
                    (found.value - printed).abs() < 1e-9,
                    "{joint:?} {found:?} {printed}"
                );
            }
            assert!(!fit.break_in_linear && (fit.r_squared - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn the_currents_of_the_thesis_do_not_give_back_k_1() {
        // 0, 0.2, … 1 A: only 0 lies below the break, and the table's own K(0.2 A) is that of the quadratic piece.
        for (joint, k_1) in [
            (Joint::A, 6.014),
            (Joint::E, 4.226),
            (Joint::B, 4.682),
            (Joint::C, 4.738),
        ] {
            let currents = [0.0, 0.2, 0.4, 0.6, 0.8, 1.0];
            let steady: Vec<(f64, f64, usize)> = currents
                .into_iter()
                .enumerate()
                .map(|(group, i)| (i, torque_gain(joint, i), group))
                .collect();
            let fit = gain_fit(&steady).unwrap();
            assert!(fit.break_in_linear);
            assert!(
                (fit.linear[0].value - k_1).abs() < 1e-9,
                "{joint:?} {:?}",
                fit.linear
            );
        }
    }

    #[test]
    fn exact_time_constants_give_back_table_3_3() {
        for joint in Joint::ALL {
            for edge in Edge::ALL {
                let mut measured = Vec::new();
                for current_a in [0.23, 0.47, 0.81, 0.97] {
                    for omega_rpm in [0.53, 0.77, 1.13, 1.71] {
                        let omega_rad_s = rad_s_from_rpm(omega_rpm);
                        let a_s = time_constant(joint, current_a, omega_rad_s, edge);
                        measured.push((current_a, omega_rpm, a_s));
                    }
                }
                let fit = surface_fit(&measured, edge).unwrap();
                let t = time_constant_fit(joint, edge);
                let printed = [t.a_1, t.a_2, t.a_3, t.a_4, t.a_5, t.a_6];
                for (found, printed) in fit.coefficients.iter().zip(printed) {
                    assert!((found.value - printed).abs() < 1e-11, "{joint:?} {found:?}");
                }
                assert!(!fit.with_threshold);
            }
        }
    }

    #[test]
    fn two_speeds_below_the_threshold_do_not_tell_the_falling_surface() {
        let at = |speeds: &[f64]| {
            let mut measured = Vec::new();
            for current_a in [0.2, 0.4, 0.6, 0.8, 1.0] {
                for &omega_rpm in speeds {
                    let omega_rad_s = rad_s_from_rpm(omega_rpm);
                    let a_s = time_constant(Joint::C, current_a, omega_rad_s, Edge::Falling);
                    measured.push((current_a, omega_rpm, a_s));
                }
            }
            surface_fit(&measured, Edge::Falling)
        };
        assert!(at(&[0.5, 1.0]).is_none());
        assert!(at(&[0.5, 1.0, 2.0]).unwrap().with_threshold);
    }

    #[test]
    fn the_falling_surface_meets_the_average_at_its_threshold() {
        // At 2 rpm ω_L = 1: a1 + a3 + a5 is the slope over the current, a2 + a4 + a6 the value.
        for joint in Joint::ALL {
            let t = time_constant_fit(joint, Edge::Falling);
            assert!((t.a_1 + t.a_3 + t.a_5).abs() < 1e-12, "{joint:?}");
            assert!(
                (t.a_2 + t.a_4 + t.a_6 - t.a_avg_s).abs() < 1.01e-4,
                "{joint:?}"
            );
            // The rising ones, fitted to four speeds, keep a slope at their 4 rpm, ω_L = 2, and miss the average.
            let t = time_constant_fit(joint, Edge::Rising);
            assert!(
                (t.a_1 + 2.0 * t.a_3 + 4.0 * t.a_5).abs() > 0.9e-4,
                "{joint:?}"
            );
        }
    }
}
