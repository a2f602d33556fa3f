//! This file shows a folder of runs in a browser on this machine, and diagnoses new recordings as they come.

mod answer;
mod connect;
mod head;
mod listing;
mod pages;
mod watch;

use std::net::{IpAddr, Ipv4Addr, SocketAddr, TcpListener};
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::Duration;

use crate::outcome::{Failure, Outcome, print};
use answer::Site;
use watch::{Watch, watched};

/// What is to be shown.
#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
pub struct Args {
    /// The folder with the runs: folders that `diagnose` and `certify` wrote, and recordings to come
    folder: PathBuf,
    /// The rig of recordings that come: each is diagnosed as soon as it is whole. Without it nothing is diagnosed
    #[arg(long, value_name = "TOML")]
    rig: Option<PathBuf>,
    /// The port; 0 takes a free one
    #[arg(long, value_name = "PORT", default_value_t = 7077)]
    port: u16,
    /// Stop by itself after this time
    #[arg(long, value_name = "SECONDS")]
    for_s: Option<u32>,
}

const AFTER_HELP: &str = "\
Only this machine can see it: it listens on 127.0.0.1, answers to that name alone, and shows nothing but the files of runs. End it with Ctrl-C.

Example:
  rigproof serve runs --rig rig.toml";

/// Serves until it is ended.
pub fn run(args: &Args) -> Result<Outcome, Failure> {
    if !args.folder.is_dir() {
        let problem = "it is no folder; name the one that holds the runs".to_owned();
        return Err(Failure::unusable(&args.folder, problem));
    }
    if let Some(rig) = &args.rig {
        // A wrong description is refused now, not at the first recording.
        rigproof_diagnose::Description::read(rig)?;
    }
    let address = SocketAddr::new(IpAddr::V4(Ipv4Addr::LOCALHOST), args.port);
    let refused = |error: String| {
        Failure::Input(format!(
            "cannot listen on {address}: {error}; give another port with --port"
        ))
    };
    let listener = TcpListener::bind(address).map_err(|error| refused(error.to_string()))?;
    let port = listener.local_addr().map_or(args.port, |own| own.port());
    print(&format!("http://127.0.0.1:{port}/"))?;
    let ends = Arc::new(AtomicBool::new(false));
    let watch = Arc::new(Watch::default());
    let site = Arc::new(Site {
        folder: args.folder.clone(),
        port,
        is_watching: args.rig.is_some(),
        watch: Arc::clone(&watch),
        reading: Mutex::new(()),
    });
    // It ends with the program.
    thread::spawn(move || connect::listen(&listener, &site));
    thread::scope(|scope| {
        if let Some(rig) = &args.rig {
            let (watch, ends) = (Arc::clone(&watch), Arc::clone(&ends));
            scope.spawn(move || watched(&args.folder, rig, &watch, &ends));
        }
        match args.for_s {
            Some(seconds) => thread::sleep(Duration::from_secs(seconds.into())),
            None => loop {
                thread::park();
            },
        }
        ends.store(true, Ordering::Relaxed);
    });
    Ok(Outcome { checks_hold: true })
}
