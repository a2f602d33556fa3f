//! This file writes the description of an arm: its URDF, inside the description of its recording.

use super::body::{Body, Member};
use super::setup::Setup;
use std::fmt::Write;

/// The description, TOML, with the URDF in it.
pub fn toml(seed: u64, setup: &Setup) -> String {
    let mut text = format!(
        "name = \"blind chain {seed}\"\nplant = \"chain\"\nurdf = '''\n{}'''\n",
        urdf(&setup.body)
    );
    for (k, (member, [count, noise])) in setup.body.joints.iter().zip(&setup.sensors).enumerate() {
        let joint = k + 1;
        let (motion, travel, effort) = match member.slides {
            true => ("linear", "m", "N"),
            false => ("rotary", "rad", "N·m"),
        };
        // Writing to a string cannot fail.
        let _ = write!(
            text,
            "\n[[joint]]\nname = \"joint{joint}\"\nmotion = \"{motion}\"\n\
             position = {{ channel = \"q{joint}\", unit = \"{travel}\", quantum = {count} }}\n\
             effort = {{ channel = \"tau{joint}\", unit = \"{effort}\", noise = {noise} }}\n",
        );
    }
    text
}

fn numbers(values: [f64; 3]) -> String {
    values.map(|x| x.to_string()).join(" ")
}

fn urdf(body: &Body) -> String {
    let mut text = "<robot name=\"arm\">\n  <link name=\"base\"/>\n".to_owned();
    for (k, member) in body.joints.iter().enumerate() {
        joint(&mut text, k, member);
    }
    // Writing to a string cannot fail.
    let _ = write!(
        text,
        "  <joint name=\"flange\" type=\"fixed\">\n    <origin xyz=\"{}\"/>\n    \
         <parent link=\"link{}\"/><child link=\"tool\"/>\n  </joint>\n  <link name=\"tool\"/>\n",
        numbers(body.flange),
        body.joints.len(),
    );
    text.push_str("</robot>\n");
    text
}

fn joint(text: &mut String, k: usize, member: &Member) {
    let before = match k {
        0 => "base".to_owned(),
        _ => format!("link{k}"),
    };
    let own = k + 1;
    let kind = if member.slides {
        "prismatic"
    } else {
        "revolute"
    };
    let [xx, xy, xz, yy, yz, zz] = member.link.moments;
    let friction = match member.dry > 0.0 {
        true => format!(
            "    <dynamics damping=\"{}\" friction=\"{}\"/>\n",
            member.viscous, member.dry
        ),
        false => String::new(),
    };
    // Writing to a string cannot fail.
    let _ = write!(
        text,
        "  <joint name=\"joint{own}\" type=\"{kind}\">\n    <origin xyz=\"{}\" rpy=\"{}\"/>\n    \
         <parent link=\"{before}\"/><child link=\"link{own}\"/><axis xyz=\"0 0 {}\"/>\n{friction}  </joint>\n  \
         <link name=\"link{own}\">\n    <inertial>\n      <origin xyz=\"{}\"/><mass value=\"{}\"/>\n      \
         <inertia ixx=\"{xx}\" ixy=\"{xy}\" ixz=\"{xz}\" iyy=\"{yy}\" iyz=\"{yz}\" izz=\"{zz}\"/>\n    </inertial>\n  </link>\n",
        numbers(member.place),
        numbers(member.angles),
        member.sense,
        numbers(member.link.centre),
        member.link.mass,
    );
}
