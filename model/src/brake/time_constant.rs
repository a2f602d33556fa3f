//! This file says how fast a brake's torque follows its current.

use rigproof_spec::joint::Joint;
use rigproof_spec::tables::{BrakeTable, Edge, TimeConstantFit, brake_table, time_constant_fit};
use rigproof_spec::units::rpm_from_rad_s;

/// Time constant a of a brake as printed, s (3.5), (3.6).
///
/// ```text
/// a = a_avg                                                  ω ≥ 4 rpm rising, 2 rpm falling
/// a = a1·I + a2·ω_L + a3·I·ω_L + a4·ω_L² + a5·I·ω_L² + a6    below,   ω_L = log2 ω
/// ```
///
/// | symbol | here | unit | range |
/// |---|---|---|---|
/// | I | `current_a`: the target of a rising edge, the origin of a falling one | A | 0.2 to 1 tested |
/// | ω | `omega_rad_s`, in magnitude | rad/s (rpm in the equation) | 0.5 to 64 rpm tested |
/// | a1 … a6, `a_avg` | table 3.3 | – | – |
///
/// # Differs from the thesis
///
/// ω is taken in magnitude (erratum `speed-magnitude`). Outside what was tested the printed form becomes negative or
/// unbounded (erratum `time-constant-extrapolation`): [`bounded_time_constant`] is the form to simulate with.
///
/// ```
/// use rigproof_model::brake::time_constant;
/// use rigproof_spec::{joint::Joint, tables::Edge, units::rad_s_from_rpm};
/// let a = time_constant(Joint::A, 0.8, rad_s_from_rpm(32.0), Edge::Rising);
/// assert_eq!(a, 0.0075);
/// ```
pub fn time_constant(joint: Joint, current_a: f64, omega_rad_s: f64, edge: Edge) -> f64 {
    let fit = time_constant_fit(joint, edge);
    surface(&fit, current_a, rpm_from_rad_s(omega_rad_s.abs()), edge)
}

/// Time constant a of a brake for simulation, s: (3.5) and (3.6) at the nearest tested current and speed.
///
/// Between 3.1 ms and 131 ms for every input that is a number; at rest the value of 0.5 rpm.
///
/// # Differs from the thesis
///
/// The thesis extrapolates outside the tested range (erratum `time-constant-extrapolation`).
pub fn bounded_time_constant(joint: Joint, current_a: f64, omega_rad_s: f64, edge: Edge) -> f64 {
    table_time_constant(&brake_table(joint), current_a, omega_rad_s, edge)
}

/// Time constant a of any brake whose table is known, s: (3.5) and (3.6) at the nearest measured current and speed.
///
/// Positive and bounded exactly if the table's surfaces are, over its own range of currents and speeds.
pub fn table_time_constant(
    table: &BrakeTable,
    current_a: f64,
    omega_rad_s: f64,
    edge: Edge,
) -> f64 {
    let band = SpeedBand::of(table, omega_rad_s, edge);
    time_constant_within(table, current_a, omega_rad_s, edge, band)
}

/// Which form of [`table_time_constant`] a speed takes: the boundaries between them are kinks or steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SpeedBand {
    /// Below the lowest measured speed: the value there.
    Least,
    /// The low-speed surface.
    Surface,
    /// Above the highest measured speed, where that is a low one: the value there.
    Greatest,
    /// From the threshold of (3.5) or (3.6): the average.
    Average,
}

impl SpeedBand {
    /// The band of a speed, rad/s.
    pub fn of(table: &BrakeTable, omega_rad_s: f64, edge: Edge) -> SpeedBand {
        let omega_rpm = rpm_from_rad_s(omega_rad_s.abs());
        let [least_rpm, greatest_rpm] = table.speed_range_rpm;
        if nearest(omega_rpm, table.speed_range_rpm) >= edge.threshold_rpm() {
            SpeedBand::Average
        } else if omega_rpm <= least_rpm {
            SpeedBand::Least
        } else if omega_rpm >= greatest_rpm {
            SpeedBand::Greatest
        } else {
            SpeedBand::Surface
        }
    }
}

/// Time constant a in the form of a given band, s: smooth in the speed also a little beyond the band, for an integrator
/// that looks ahead before it finds the boundary.
pub fn time_constant_within(
    table: &BrakeTable,
    current_a: f64,
    omega_rad_s: f64,
    edge: Edge,
    band: SpeedBand,
) -> f64 {
    let current_a = nearest(current_a, table.current_range_a);
    let fit = table.time_constant(edge);
    let [least_rpm, greatest_rpm] = table.speed_range_rpm;
    match band {
        SpeedBand::Least => low_speed(fit, current_a, least_rpm),
        SpeedBand::Surface => {
            let omega_rpm = rpm_from_rad_s(omega_rad_s.abs());
            let beyond_rpm = 2.0 * edge.threshold_rpm().min(greatest_rpm);
            low_speed(fit, current_a, omega_rpm.clamp(0.5 * least_rpm, beyond_rpm))
        }
        SpeedBand::Greatest => low_speed(fit, current_a, greatest_rpm),
        SpeedBand::Average => fit.a_avg_s,
    }
}

/// The nearest value of a range; what is no number stays none.
fn nearest(value: f64, [least, greatest]: [f64; 2]) -> f64 {
    if value < least {
        least
    } else if value > greatest {
        greatest
    } else {
        value
    }
}

fn surface(fit: &TimeConstantFit, current_a: f64, omega_rpm: f64, edge: Edge) -> f64 {
    if omega_rpm >= edge.threshold_rpm() {
        return fit.a_avg_s;
    }
    low_speed(fit, current_a, omega_rpm)
}

//= thesis (3.5)
//= thesis (3.6)
fn low_speed(fit: &TimeConstantFit, current_a: f64, omega_rpm: f64) -> f64 {
    //= thesis (3.7)
    let omega_l = libm::log2(omega_rpm);
    fit.a_1 * current_a
        + fit.a_2 * omega_l
        + fit.a_3 * current_a * omega_l
        + fit.a_4 * omega_l * omega_l
        + fit.a_5 * current_a * omega_l * omega_l
        + fit.a_6
}

/// A brake's table with every rising time constant times so much, and every falling one.
pub fn slowed(table: BrakeTable, [rising, falling]: [f64; 2]) -> BrakeTable {
    let scaled = |fit: TimeConstantFit, times: f64| TimeConstantFit {
        a_avg_s: times * fit.a_avg_s,
        a_1: times * fit.a_1,
        a_2: times * fit.a_2,
        a_3: times * fit.a_3,
        a_4: times * fit.a_4,
        a_5: times * fit.a_5,
        a_6: times * fit.a_6,
        ..fit
    };
    BrakeTable {
        rising: scaled(table.rising, rising),
        falling: scaled(table.falling, falling),
        ..table
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rigproof_spec::units::rad_s_from_rpm;

    fn assert_time(a_s: f64, expected_s: f64, tolerance_s: f64) {
        assert!(
            (a_s - expected_s).abs() < tolerance_s,
            "{a_s} s, not {expected_s} s"
        );
    }

    //= thesis (3.5) test
    //= thesis (3.7) test
    #[test]
    fn rising_time_constant_follows_table_3_3_by_hand() {
        // A at 0.73 A and 0.5 rpm, ω_L = -1:
        // 0.0697*0.73 - 0.0129 + 0.0623*0.73 - 0.0055 + 0.0141*0.73 + 0.0025 = 0.090753.
        let a = time_constant(Joint::A, 0.73, rad_s_from_rpm(0.5), Edge::Rising);
        assert_time(a, 0.090_753, 1e-12);
        // C at 0.37 A and 2√2 rpm, ω_L = 1.5:
        // 0.0451*0.37 - 0.0132 - 0.0185*0.37*1.5 + 0.0055*2.25 - 0.002*0.37*2.25 + 0.0019 = 0.0058295.
        let omega_rad_s = rad_s_from_rpm(2.0 * core::f64::consts::SQRT_2);
        assert_time(
            time_constant(Joint::C, 0.37, -omega_rad_s, Edge::Rising),
            0.005_829_5,
            1e-12,
        );
        assert_eq!(time_constant(Joint::E, 0.37, 0.43, Edge::Rising), 0.0070);
    }

    //= thesis (3.6) test
    //= thesis (3.7) test
    #[test]
    fn falling_time_constant_follows_table_3_3_by_hand() {
        // B at 0.91 A and 0.5 rpm, ω_L = -1:
        // 0.0018*0.91 + 0.0007 + 0.0015*0.91 + 0.0011 - 0.0003*0.91 + 0.0052 = 0.00973.
        let a = time_constant(Joint::B, 0.91, rad_s_from_rpm(0.5), Edge::Falling);
        assert_time(a, 0.009_73, 1e-12);
        // E at 0.37 A and √2 rpm, ω_L = 0.5:
        // 0.0017*0.37 - 0.0001 - 0.0017*0.37*0.5 + 0.0006*0.25 + 0.0050 = 0.0053645.
        let a = time_constant(
            Joint::E,
            0.37,
            rad_s_from_rpm(core::f64::consts::SQRT_2),
            Edge::Falling,
        );
        assert_time(a, 0.005_364_5, 1e-12);
        assert_eq!(time_constant(Joint::B, 0.37, 0.23, Edge::Falling), 0.0057);
    }

    #[test]
    fn printed_rising_time_constant_is_negative_at_small_current() {
        let printed = |current_a, omega_rpm| {
            time_constant(Joint::A, current_a, rad_s_from_rpm(omega_rpm), Edge::Rising)
        };
        assert_time(printed(0.0, 0.5), -0.0159, 1e-12);
        assert!(printed(0.0, 0.88) < 0.0 && printed(0.0, 0.89) > 0.0);
        assert!(printed(0.1, 0.5) < 0.0 && printed(0.11, 0.5) > 0.0);
    }

    #[test]
    fn printed_rising_time_constant_is_unbounded_at_low_speed() {
        let printed =
            |current_a| time_constant(Joint::A, current_a, rad_s_from_rpm(0.01), Edge::Rising);
        assert_time(printed(0.2), -0.1048, 5e-5);
        assert_time(printed(1.0), 0.7800, 5e-5);
        assert!(!time_constant(Joint::A, 0.83, 0.0, Edge::Rising).is_finite());
    }

    #[test]
    fn time_constant_steps_at_the_speed_threshold() {
        // Printed value just below the threshold against the value above, in percent, at 0.2 and 1 A.
        for (joint, edge, at_least_current, at_greatest_current) in [
            (Joint::A, Edge::Rising, -12.0, 4.0),
            (Joint::E, Edge::Rising, 1.43, 7.14),
            (Joint::B, Edge::Rising, -3.2, 5.33),
            (Joint::C, Edge::Rising, -1.25, 0.0),
            (Joint::A, Edge::Falling, 0.0, 0.0),
            (Joint::E, Edge::Falling, 0.0, 0.0),
            (Joint::B, Edge::Falling, -1.75, -1.75),
            (Joint::C, Edge::Falling, 0.0, 0.0),
        ] {
            for (current_a, percent) in [(0.2, at_least_current), (1.0, at_greatest_current)] {
                let above = time_constant_fit(joint, edge).a_avg_s;
                let below = surface(
                    &time_constant_fit(joint, edge),
                    current_a,
                    edge.threshold_rpm().next_down(),
                    edge,
                );
                let step = (below / above - 1.0) * 100.0;
                assert!(
                    (step - percent).abs() < 0.005,
                    "{joint:?} {edge:?} {current_a} A: {step} %"
                );
            }
        }
    }

    #[test]
    fn bounded_time_constant_stays_positive_and_bounded() {
        let mut least = f64::INFINITY;
        let mut greatest = 0.0_f64;
        for joint in Joint::ALL {
            for edge in Edge::ALL {
                for current in -20..240 {
                    for omega in 0..400 {
                        let current_a = f64::from(current) * 0.005_03;
                        let omega_rad_s = rad_s_from_rpm(f64::from(omega) * 0.0117);
                        let a = bounded_time_constant(joint, current_a, omega_rad_s, edge);
                        least = least.min(a);
                        greatest = greatest.max(a);
                    }
                }
            }
        }
        assert_time(least, 0.003_161, 1e-6);
        assert_time(greatest, 0.1302, 1e-6);
    }

    #[test]
    fn bounded_and_printed_time_constant_agree_where_tested() {
        for joint in Joint::ALL {
            for edge in Edge::ALL {
                for (current_a, omega_rpm) in [(0.203, 0.507), (0.617, 1.93), (0.987, 61.3)] {
                    let omega_rad_s = rad_s_from_rpm(-omega_rpm);
                    assert_eq!(
                        bounded_time_constant(joint, current_a, omega_rad_s, edge),
                        time_constant(joint, current_a, omega_rad_s, edge)
                    );
                }
            }
        }
    }
}
