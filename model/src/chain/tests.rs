//! An arm's dynamics held to what is known otherwise: closed forms, energy, and each way of computing to the others.

use super::*;
use nalgebra::DVector;

/// An arm of three joints that turn and one that slides, with made numbers.
pub(super) const ARM: &str = r#"<robot name="made">
<link name="base"/>
<link name="one"><inertial><origin xyz="0.03 -0.02 0.11" rpy="0.1 0.2 -0.3"/><mass value="2.3"/><inertia ixx="0.021" ixy="0.002" ixz="-0.001" iyy="0.019" iyz="0.0015" izz="0.014"/></inertial></link>
<joint name="j1" type="revolute"><origin xyz="0.01 0.02 0.31" rpy="0.05 0 0.4"/><parent link="base"/><child link="one"/><axis xyz="0 0 1"/></joint>
<link name="two"><inertial><origin xyz="0.13 0.01 0.02"/><mass value="1.7"/><inertia ixx="0.011" ixy="0.001" ixz="0.002" iyy="0.017" iyz="-0.001" izz="0.013"/></inertial></link>
<joint name="j2" type="revolute"><origin xyz="0 0.05 0.12" rpy="-1.5 0.2 0"/><parent link="one"/><child link="two"/><axis xyz="0 0.6 0.8"/><dynamics damping="0.3" friction="0.2"/></joint>
<link name="three"><inertial><origin xyz="0.02 0.03 0.07"/><mass value="0.9"/><inertia ixx="0.004" ixy="0" ixz="0.0003" iyy="0.005" iyz="0" izz="0.003"/></inertial></link>
<joint name="j3" type="prismatic"><origin xyz="0.27 0 0" rpy="0.3 -0.7 0.2"/><parent link="two"/><child link="three"/><axis xyz="1 0 0"/></joint>
<link name="flange"><inertial><origin xyz="0.01 0 0.01"/><mass value="0.4"/><inertia ixx="0.001" ixy="0" ixz="0" iyy="0.0012" iyz="0" izz="0.0009"/></inertial></link>
<joint name="f" type="fixed"><origin xyz="0 0.1 0.05" rpy="0.9 0 0.4"/><parent link="three"/><child link="flange"/></joint>
<link name="tool"><inertial><origin xyz="0 0.04 0.06"/><mass value="0.6"/><inertia ixx="0.002" ixy="0.0001" ixz="0" iyy="0.0015" iyz="0.0002" izz="0.001"/></inertial></link>
<joint name="j4" type="continuous"><origin xyz="0.02 0 0.09" rpy="0 1.1 0"/><parent link="flange"/><child link="tool"/><axis xyz="0 1 0"/></joint>
</robot>"#;

const Q: [f64; 4] = [0.71, -1.13, 0.21, 2.37];
const SPEED: [f64; 4] = [1.31, -0.83, 0.47, 2.11];
const FASTER: [f64; 4] = [-3.1, 2.7, 1.9, -4.3];

fn arm() -> Chain {
    Chain::from_urdf(ARM, None).unwrap()
}

#[test]
fn efforts_are_the_regressor_times_the_numbers() {
    let arm = arm();
    let efforts = arm.efforts(&Q, &SPEED, &FASTER);
    let numbers = DVector::from_vec(arm.parameters());
    let linear = arm.regressor(&Q, &SPEED, &FASTER) * &numbers;
    let base = arm.base();
    let few = arm
        .regressor(&Q, &SPEED, &FASTER)
        .select_columns(&base.columns)
        * DVector::from_vec(base.of(&arm.parameters()));
    assert!(base.columns.len() < 40, "{}", base.columns.len());
    for k in 0..4 {
        assert!((efforts[k] - linear[k]).abs() < 1e-12 * efforts[k].abs().max(1.0));
        assert!((efforts[k] - few[k]).abs() < 1e-9 * efforts[k].abs().max(1.0));
    }
}

#[test]
fn momentum_and_what_stands_beside_it_give_the_efforts() {
    let arm = arm();
    let numbers = DVector::from_vec(arm.parameters());
    let at = |t: f64| -> [[f64; 4]; 2] {
        let q = core::array::from_fn(|k| Q[k] + SPEED[k] * t + 0.5 * FASTER[k] * t * t);
        [q, core::array::from_fn(|k| SPEED[k] + FASTER[k] * t)]
    };
    let momentum = |t: f64| {
        let [q, speed] = at(t);
        arm.momentum(&q, &speed).momentum * &numbers
    };
    let h = 1e-5;
    let rate = (momentum(h) - momentum(-h)) / (2.0 * h);
    let own = rate + arm.momentum(&Q, &SPEED).rest * &numbers;
    let efforts = arm.efforts(&Q, &SPEED, &FASTER);
    for k in 0..4 {
        assert!(
            (efforts[k] - own[k]).abs() < 1e-7,
            "{k}: {} {}",
            efforts[k],
            own[k]
        );
    }
}

#[test]
fn power_is_the_rate_of_the_energy() {
    let arm = arm();
    let energy = |t: f64| {
        let q: Vec<f64> = (0..4)
            .map(|k| Q[k] + SPEED[k] * t + 0.5 * FASTER[k] * t * t)
            .collect();
        let speed: Vec<f64> = (0..4).map(|k| SPEED[k] + FASTER[k] * t).collect();
        arm.energy(&q, &speed).iter().sum::<f64>()
    };
    let h = 1e-5;
    let rate = (energy(h) - energy(-h)) / (2.0 * h);
    let efforts = arm.efforts(&Q, &SPEED, &FASTER);
    let power: f64 = efforts.iter().zip(SPEED).map(|(e, v)| e * v).sum();
    assert!((rate - power).abs() < 1e-6 * power.abs(), "{rate} {power}");
}

#[test]
fn the_matrix_of_masses_is_symmetric_and_positive() {
    let masses = arm().mass_matrix(&Q);
    let skew = (&masses - masses.transpose()).amax();
    assert!(skew < 1e-13, "{skew}");
    assert!(masses.symmetric_eigen().eigenvalues.min() > 1e-4);
}

/// Two links that turn about parallel level axes, points of mass at their ends.
#[test]
fn two_links_are_the_closed_form() {
    let (l, a, b) = (0.37, 1.3, 0.7);
    let point = |x: f64, m: f64| {
        format!(
            "<inertial><origin xyz=\"{x} 0 0\"/><mass value=\"{m}\"/><inertia ixx=\"0\" ixy=\"0\" ixz=\"0\" iyy=\"0\" iyz=\"0\" izz=\"0\"/></inertial>"
        )
    };
    let text = format!(
        "<robot name=\"two\"><link name=\"o\"/><link name=\"u\">{}</link><link name=\"w\">{}</link>\
         <joint name=\"s\" type=\"revolute\"><parent link=\"o\"/><child link=\"u\"/><axis xyz=\"0 -1 0\"/></joint>\
         <joint name=\"e\" type=\"revolute\"><origin xyz=\"{l} 0 0\"/><parent link=\"u\"/><child link=\"w\"/><axis xyz=\"0 -1 0\"/></joint></robot>",
        point(l, a),
        point(0.29, b)
    );
    let (m, k, g) = (a + b, 0.29, 9.81);
    let arm = Chain::from_urdf(&text, None).unwrap();
    let ([p, q], [v, w], [x, y]) = ([0.4, 0.9], [1.7, -0.6], [2.3, 3.1]);
    let efforts = arm.efforts(&[p, q], &[v, w], &[x, y]);
    let (c, s) = (libm::cos(q), libm::sin(q));
    let far = b * k * g * libm::cos(p + q);
    let first = (m * l * l + b * k * k + 2.0 * b * l * k * c) * x + (b * k * k + b * l * k * c) * y
        - b * l * k * s * (2.0 * v * w + w * w)
        + m * g * l * libm::cos(p)
        + far;
    let second = (b * k * k + b * l * k * c) * x + b * k * k * y + b * l * k * s * v * v + far;
    assert!((efforts[0] - first).abs() < 1e-12, "{} {first}", efforts[0]);
    assert!(
        (efforts[1] - second).abs() < 1e-12,
        "{} {second}",
        efforts[1]
    );
}

#[test]
fn what_is_no_serial_arm_is_said_in_one_line() {
    let says = |text: &str| Chain::from_urdf(text, None).unwrap_err().to_string();
    for (from, to, word) in [
        (
            "<mass value=\"1.7\"/>",
            "<mass value=\"-1.7\"/>",
            "negative",
        ),
        ("<mass value=\"1.7\"/>", "", "no `mass`"),
        ("izz=\"0.013\"", "izz=\"0.031\"", "triangle"),
        (
            "<axis xyz=\"1 0 0\"/>",
            "<axis xyz=\"1 0 0\"/><mimic joint=\"j1\"/>",
            "mimic",
        ),
        ("type=\"prismatic\"", "type=\"planar\"", "planar"),
        ("<child link=\"tool\"/>", "<child link=\"one\"/>", "loop"),
        ("<parent link=\"base\"/>", "<parent link=\"tool\"/>", "loop"),
        ("<parent link=\"two\"/>", "<parent link=\"twos\"/>", "twos"),
        (
            "</robot>",
            "<link name=\"more\"/><joint name=\"m\" type=\"fixed\"><parent link=\"two\"/><child link=\"more\"/></joint></robot>",
            "branches",
        ),
        ("<robot name=\"made\">", "<robots>", "XML"),
    ] {
        let said = says(&ARM.replacen(from, to, 1));
        assert!(
            said.contains(word) && !said.contains('\n'),
            "{word}: {said}"
        );
    }
    let bare = ARM.split("<link name=\"tool\">").next().unwrap().to_owned()
        + "<link name=\"tool\"><visual/></link>"
        + ARM.rsplit_once("</link>").unwrap().1;
    assert!(says(&bare).contains("no `inertial`"), "{}", says(&bare));
    assert!(
        Chain::from_urdf(ARM, Some("hand"))
            .unwrap_err()
            .to_string()
            .contains("no link `hand`")
    );
}

#[test]
fn links_fixed_to_one_another_are_one_and_nothing_is_attached_beyond_the_tip() {
    let whole = arm();
    assert_eq!(whole.joints.len(), 4);
    assert!((whole.joints[2].inertial.mass - 1.3).abs() < 1e-12);
    let part = Chain::from_urdf(ARM, Some("three")).unwrap();
    assert_eq!(part.joints.len(), 3);
    assert!((part.joints[2].inertial.mass - 0.9).abs() < 1e-12);
}

/// What a heavier link changes is a combination of that link's own numbers; the base parameters need those of its neighbours for it.
#[test]
fn a_link_is_told_by_its_own_numbers_alone() {
    let arm = arm();
    let own = arm.of_each_link();
    let kept = |link: usize| own.iter().filter(move |c| **c / INERTIAL == link);
    assert_eq!(kept(3).count(), INERTIAL);
    let states = (0..40).map(|k| {
        let at = |of: [f64; 4], rate: f64| of.map(|x| x * libm::cos(rate * f64::from(k) + x));
        arm.regressor(&at(Q, 0.7), &at(SPEED, 1.3), &at(FASTER, 0.4))
    });
    let blocks: Vec<_> = states.collect();
    let stacked = nalgebra::DMatrix::from_fn(160, 40, |row, c| blocks[row / 4][(row % 4, c)]);
    for link in 0..4 {
        let numbers = arm.joints[link].inertial.numbers();
        let numbers = DVector::from_iterator(INERTIAL, numbers);
        let more = stacked.columns(INERTIAL * link, INERTIAL) * (0.3 * numbers);
        let columns: Vec<usize> = kept(link).copied().collect();
        let few = stacked.select_columns(&columns);
        let fit = few.clone().svd(true, true).solve(&more, 1e-12).unwrap();
        let left = (&more - few * fit).norm() / more.norm();
        assert!(left < 1e-9, "link {link}: {left}");
    }
}
