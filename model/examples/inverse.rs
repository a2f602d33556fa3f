//! This program prints the efforts of an arm's joints, friction of Coulomb left out, for states on standard input: `inverse FILE [TIP]`.
//!
//! A line in is a state, positions, speeds and accelerations of all joints (rad or m and per s, per s²). A line out is the efforts, N·m or N.

use rigproof_model::chain::Chain;
use std::error::Error;
use std::io::{BufRead, stdin};

fn main() -> Result<(), Box<dyn Error>> {
    let mut args = std::env::args().skip(1);
    let file = args.next().ok_or("name the URDF or MJCF of an arm")?;
    let (text, tip) = (std::fs::read_to_string(file)?, args.next());
    let arm = Chain::from_model(&text, tip.as_deref())?;
    for line in stdin().lock().lines() {
        let line = line?;
        let numbers = line.split_whitespace().map(str::parse);
        let numbers: Vec<f64> = numbers.collect::<Result<_, _>>()?;
        let [q, speed, acceleration] =
            numbers.chunks_exact(arm.joints.len()).collect::<Vec<_>>()[..]
        else {
            return Err(format!("a line needs {} numbers", 3 * arm.joints.len()).into());
        };
        let efforts = arm.efforts(q, speed, acceleration).into_iter();
        let joints = arm.joints.iter().zip(speed);
        let efforts = efforts
            .zip(joints)
            .map(|(own, (joint, speed))| own + joint.damping * speed);
        println!(
            "{}",
            efforts
                .map(|own| own.to_string())
                .collect::<Vec<_>>()
                .join(" ")
        );
    }
    Ok(())
}
