//! This file holds the plant's closed form against the reference's: places, rows, mass, bias and accelerations.

use rigproof_impl::linkage::{Shape, linkage};
use rigproof_impl::plant::form::{Bodies, form};
use rigproof_impl::vector::Vector;
use rigproof_model::linkage::forward;
use rigproof_model::motion::two_coordinate::two_coordinate;

use crate::budget::assert_within_budget;
use crate::impl_plant::rigs::{Draw, campaign};

fn unit(angle_rad: f64) -> Vector<f64> {
    let (sine, cosine) = libm::sincos(angle_rad);
    Vector::new(cosine, sine)
}

#[test]
fn the_closed_form_is_the_reference_in_random_states() {
    let mut draw = Draw::new(7151);
    let [
        mut places,
        mut masses,
        mut biases,
        mut rows,
        mut accelerations,
    ] = [const { Vec::new() }; 5];
    let states = campaign(100_000);
    let mut tried = 0;
    while places.len() < states {
        tried += 1;
        let arms = draw.arms(tried);
        let inertia = draw.inertia();
        let theta = [draw.between(-0.4, 3.9), draw.between(-0.9, 3.3)];
        let Ok(pose) = forward::pose(&arms, theta[0], theta[1]) else {
            continue;
        };
        let sines =
            [pose.theta_e_rad, pose.theta_c_rad, pose.theta_d_rad].map(|a| libm::sin(a).abs());
        if sines.into_iter().any(|sine| sine < 0.17) {
            continue;
        }
        let rates = [draw.between(-7.1, 7.1), draw.between(-7.1, 7.1)];
        let force = [draw.between(-31.0, 31.0), draw.between(-31.0, 31.0)];
        let expected = two_coordinate(&arms, &inertia, &pose, rates);

        let at = linkage(&Shape::new(&arms), unit(theta[0]), unit(theta[1]));
        let got = form(&Bodies::<f64>::new(&arms, &inertia), &at, rates.into());
        places.push((at.tip_m - Vector::from(pose.tip_m)).norm());
        let size = expected.mass.norm();
        let [aa, ab, bb] = [(0, 0), (0, 1), (1, 1)].map(|place| expected.mass[place]);
        let mass = [got.mass.aa - aa, got.mass.ab - ab, got.mass.bb - bb];
        masses.push(
            mass.into_iter()
                .fold(0.0, |most: f64, off| most.max(off.abs()))
                / size,
        );
        let bias = got.bias_nm - Vector::new(expected.bias.x, expected.bias.y);
        // A bias is a mass times squares of rates.
        biases.push(bias.norm() / (size * (rates[0].abs() + rates[1].abs()).powi(2)));
        let longest = expected.joints.norm();
        let mut worst = 0.0_f64;
        let ahead = got.joint_rows_ahead(1.0);
        for (i, (row, ahead)) in got.joint_rows().into_iter().zip(ahead).enumerate() {
            let off = row - Vector::new(expected.joints[(i, 0)], expected.joints[(i, 1)]);
            // The change of the rows times the rates is what the joints accelerate without the coordinates.
            let turning = (ahead - row).dot(rates.into()) - expected.joints_bias[i];
            let fast = (rates[0].abs() + rates[1].abs()).powi(2) * longest * longest;
            worst = worst.max(off.norm() / longest).max(turning.abs() / fast);
        }
        rows.push(worst);
        let load = got.tip_load(&at, force.into()) - got.bias_nm;
        let got = got.mass.solve(load);
        let [a, b] = expected.acceleration_rad_s2(force, [0.0; 4]);
        accelerations.push((got - Vector::new(a, b)).norm() / Vector::new(a, b).norm());
    }
    println!("{} states of {tried} tried", places.len());
    assert_within_budget("plant_form_place", places);
    assert_within_budget("plant_form_mass", masses);
    assert_within_budget("plant_form_bias", biases);
    assert_within_budget("plant_form_rows", rows);
    assert_within_budget("plant_form_acceleration", accelerations);
}
