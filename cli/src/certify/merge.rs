//! This file joins the parts of a campaign.

use std::path::PathBuf;

use rigproof_certify::campaign;
use rigproof_certify::journal::{self, Header};
use rigproof_trace::TraceError;

use super::campaign as parts;
use super::compiled::{Compiled, sources};
use super::sign;
use crate::outcome::{Failure, Outcome};

/// What is to be joined.
#[derive(clap::Args)]
#[command(after_help = AFTER_HELP)]
pub struct Args {
    /// The folders of all parts
    #[arg(required = true, value_name = "FOLDER")]
    folders: Vec<PathBuf>,
    /// The folder for the certificate
    #[arg(long, value_name = "FOLDER")]
    out: PathBuf,
    /// Sign the certificate with this secret key, in PEM
    #[arg(long, value_name = "KEYFILE")]
    sign: Option<PathBuf>,
    #[command(flatten)]
    compiled: Compiled,
    /// Print the certificate
    #[arg(long)]
    json: bool,
}

const AFTER_HELP: &str = "\
The certificate is that of the same campaign run in one piece, bit for bit. Parts are spread by what is at hand:
  Slurm:         sbatch --array=1-8 --wrap 'rigproof certify certify.toml --shard $SLURM_ARRAY_TASK_ID/8 --out part-$SLURM_ARRAY_TASK_ID'
  GNU parallel:  parallel rigproof certify certify.toml --shard {}/8 --out part-{} ::: 1 2 3 4 5 6 7 8
  Kubernetes:    an indexed Job of 8 that runs rigproof certify certify.toml --shard $((JOB_COMPLETION_INDEX + 1))/8 --out part-$JOB_COMPLETION_INDEX

Example:
  rigproof certify merge part-1 part-2 --out certified";

/// Joins and certifies.
pub fn run(args: &Args) -> Result<Outcome, Failure> {
    let keys = args.sign.as_deref().map(sign::secret).transpose()?;
    let tool = parts::tool()?;
    let (plan, chunks) = campaign::merge(&args.folders, &tool)?;
    std::fs::create_dir_all(&args.out).map_err(|error| {
        Failure::from(TraceError::File {
            action: "write",
            path: args.out.clone(),
            source: error,
        })
    })?;
    campaign::withdraw(&args.out)?;
    let header = Header {
        plan,
        shard: [0, 1],
        tool,
    };
    let compiled = args.compiled.opened_again(&header.plan.controller)?;
    let written = parts::Written {
        folder: &args.out,
        library: args.compiled.library(),
        compiled: compiled.as_ref(),
        keys,
        as_json: args.json,
    };
    let sources = sources(&header.plan, compiled.as_ref())?;
    // So that the certificate has its records beside it.
    journal::write(&args.out, &header, &chunks)?;
    parts::finish(&header.plan, &sources, &chunks, &written)
}
