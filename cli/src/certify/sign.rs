//! This file signs certificates with an ordinary key file, makes such keys, and says whether a signature holds.

use std::path::{Path, PathBuf};

use ed25519_compact::{KeyPair, PublicKey, Seed, Signature};
use rigproof_trace::store::{read_text, write_aside, write_new};

use super::compiled::Compiled;
use super::{axis, check};
use crate::outcome::{Failure, Outcome, print};

/// What a secret key is made for.
#[derive(clap::Args)]
#[command(after_help = AFTER_HELP_OF_KEY)]
pub struct Key {
    /// The file for the secret key; the public one is written beside it as FILE.pub
    #[arg(value_name = "FILE")]
    file: PathBuf,
}

const AFTER_HELP_OF_KEY: &str = "\
The files are Ed25519 keys in PEM, as `openssl genpkey -algorithm ed25519` makes them. Who has the secret one can sign: keep it where only you can read it.

Example:
  rigproof certify key lab.pem";

/// What is signed.
#[derive(clap::Args)]
#[command(after_help = AFTER_HELP_OF_SIGN)]
pub struct Sign {
    /// The certificate
    #[arg(value_name = "CERTIFICATE.JSON")]
    certificate: PathBuf,
    /// The secret key, in PEM
    #[arg(long, value_name = "KEYFILE")]
    key: PathBuf,
    /// Scenarios that are run again before
    #[arg(long, value_name = "N", default_value_t = 64)]
    sample: u64,
    /// Of an axis: the compiled controller that stood beside it
    #[arg(long, value_name = "LIBRARY")]
    old: Option<PathBuf>,
    #[command(flatten)]
    compiled: Compiled,
}

const AFTER_HELP_OF_SIGN: &str = "\
What does not hold is not signed: it is checked first, as `rigproof certify --check` does.
The signature is the 64 bytes of Ed25519 (RFC 8032) over the file, beside it as CERTIFICATE.JSON.sig. Other programs verify it too:
  openssl pkeyutl -verify -pubin -inkey lab.pem.pub -rawin -in certificate.json -sigfile certificate.json.sig

Example:
  rigproof certify sign certified/certificate.json --key lab.pem";

/// Makes a key; neither file may be there. A secret key that stands there alone, as a kill between both files leaves it, gets its public half.
pub fn make_key(args: &Key) -> Result<Outcome, Failure> {
    let public = beside(&args.file, "pub");
    let shown = (args.file.display(), public.display());
    if args.file.is_file() && std::fs::symlink_metadata(&public).is_err() {
        let keys = secret(&args.file)?;
        write_new(&public, keys.pk.to_pem().as_bytes(), false)?;
        return print(&format!(
            "The secret key {} was there already. Its public key: {}.",
            shown.0, shown.1
        ));
    }
    for file in [&args.file, &public] {
        if std::fs::symlink_metadata(file).is_ok() {
            let problem = "a key is never written over; name another file".to_owned();
            return Err(Failure::unusable(file, problem));
        }
    }
    let mut seed = [0; Seed::BYTES];
    getrandom::fill(&mut seed)
        .map_err(|error| Failure::Input(format!("the system gives no random numbers: {error}")))?;
    let keys = KeyPair::from_seed(Seed::new(seed));
    // The secret one first: the other can be made of it.
    write_new(&args.file, keys.sk.to_pem().as_bytes(), true)?;
    write_new(&public, keys.pk.to_pem().as_bytes(), false)?;
    print(&format!(
        "Secret key: {} (who has it can sign). Public key: {}.",
        shown.0, shown.1
    ))
}

/// Signs a certificate that was written before.
pub fn sign(args: &Sign) -> Result<Outcome, Failure> {
    let keys = secret(&args.key)?;
    let text = read_text(&args.certificate)?;
    let file = &args.certificate;
    let wrong = match axis::is_certificate(&text) {
        true => {
            let old = args.old.as_deref();
            axis::check::looked_through(&text, file, &args.compiled, old)?.1
        }
        false => {
            let seed = check::unforeseen()?;
            check::looked_through(&text, file, &args.compiled, args.sample, seed)?
                .1
                .wrong
        }
    };
    if !wrong.is_empty() {
        let wrong = wrong.join("; ");
        let problem = format!("it does not hold and is not signed: {wrong}");
        return Err(Failure::unusable(file, problem));
    }
    let signature = write(&keys, &args.certificate, text.as_bytes())?;
    print(&format!("Signed: {}", signature.display()))
}

/// The keys of a secret key's file.
///
/// # Errors
/// It cannot be read, or holds no such key.
pub fn secret(file: &Path) -> Result<KeyPair, Failure> {
    KeyPair::from_pem(&read_text(file)?).map_err(|_| {
        let problem = "it holds no secret Ed25519 key in PEM (`BEGIN PRIVATE KEY`); make one with `rigproof certify key` or `openssl genpkey -algorithm ed25519`";
        Failure::unusable(file, problem.to_owned())
    })
}

/// The signature's file of a certificate.
pub fn file_of(certificate: &Path) -> PathBuf {
    beside(certificate, "sig")
}

/// Writes the signature of a certificate's bytes beside it; its file.
///
/// # Errors
/// The system refuses.
pub fn write(keys: &KeyPair, certificate: &Path, bytes: &[u8]) -> Result<PathBuf, Failure> {
    let file = file_of(certificate);
    write_aside(&file, keys.sk.sign(bytes, None).as_ref())?;
    Ok(file)
}

/// What is to be said of a certificate's signature, and what is wrong with it.
///
/// # Errors
/// The key or the signature cannot be read.
pub fn looked_at(
    certificate: &Path,
    bytes: &[u8],
    public: Option<&Path>,
) -> Result<Looked, Failure> {
    let file = file_of(certificate);
    let Some(key) = public else {
        return Ok(match file.exists() {
            true => Looked::NotLookedAt,
            false => Looked::NotSigned,
        });
    };
    let own = PublicKey::from_pem(&read_text(key)?).map_err(|_| {
        let problem = "it holds no public Ed25519 key in PEM (`BEGIN PUBLIC KEY`)";
        Failure::unusable(key, problem.to_owned())
    })?;
    let read = std::fs::read(&file).map_err(|error| {
        Failure::unusable(
            &file,
            format!("the certificate's signature cannot be read: {error}"),
        )
    })?;
    let holds = Signature::from_slice(&read).is_ok_and(|read| own.verify(bytes, &read).is_ok());
    Ok(match holds {
        true => Looked::Holds,
        false => Looked::DoesNotHold,
    })
}

/// What was seen of a signature.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Looked {
    /// There is none.
    NotSigned,
    /// There is one, and no key to look at it with.
    NotLookedAt,
    /// It is the key's, of these bytes.
    Holds,
    /// It is of other bytes or of another key.
    DoesNotHold,
}

impl Looked {
    /// Its name in JSON.
    pub const fn key(self) -> &'static str {
        match self {
            Looked::NotSigned => "none",
            Looked::NotLookedAt => "not_looked_at",
            Looked::Holds => "holds",
            Looked::DoesNotHold => "does_not_hold",
        }
    }

    /// In words; nothing where there is no signature.
    pub const fn words(self) -> Option<&'static str> {
        match self {
            Looked::NotSigned => None,
            Looked::NotLookedAt => {
                Some("It is signed; whose signature it is was not looked at: give --public-key.")
            }
            Looked::Holds => Some("It is signed by the owner of this key."),
            Looked::DoesNotHold => Some("The signature is not this key's, or is of other bytes."),
        }
    }
}

/// A file's name with something behind it.
fn beside(file: &Path, ending: &str) -> PathBuf {
    let mut name = file.as_os_str().to_owned();
    name.push(".");
    name.push(ending);
    PathBuf::from(name)
}
