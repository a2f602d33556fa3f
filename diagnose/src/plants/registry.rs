//! This file is the registry of plants, a line each, and what is diagnosed whichever plant it is: a rig's description and a recording of it.

use crate::diagnose::{Diagnosis, Options, diagnose};
use crate::plant::{Described, Plant, Replayed, Simulated, Unsimulated};
use rand_pcg::Pcg64Mcg;
use rigproof_trace::csv::{Dialect, Hints};
use rigproof_trace::rig::Rig;
use rigproof_trace::rig::chain::ChainRig;
use rigproof_trace::rig::five_bar::FiveBar;
use rigproof_trace::{Trace, TraceError, store};
use std::path::Path;

/// A recording of a plant before noise and counts, whichever plant it is.
pub type Replica = crate::plant::Replica<Measured>;

macro_rules! plants {
    ($(#[doc = $doc:literal] $name:ident($plant:ty),)+) => {
        /// What a rig file describes.
        #[derive(Clone, Debug, PartialEq)]
        #[expect(clippy::large_enum_variant, reason = "few are ever made")]
        pub enum Description {
            $(#[doc = $doc] $name($plant),)+
        }

        /// A recording in SI units.
        #[derive(Clone, Debug, PartialEq)]
        #[expect(clippy::large_enum_variant, reason = "few are ever made")]
        pub enum Measured {
            $(#[doc = $doc] $name(<$plant as Plant>::Recording),)+
        }

        impl Description {
            /// The plant's name in reports.
            pub fn plant_name(&self) -> &'static str {
                match self {
                    $(Description::$name(own) => own.plant_name(),)+
                }
            }

            /// What people call the rig.
            pub fn name(&self) -> &str {
                match self {
                    $(Description::$name(own) => own.rig_name(),)+
                }
            }

            /// Reads a description of any plant; `origin` is the file that messages name.
            ///
            /// # Errors
            /// It describes none of them.
            pub fn parse(text: &str, origin: &Path) -> Result<Description, TraceError> {
                $(if <$plant>::describes(text, origin)? {
                    return <$plant as Described>::read(text, origin).map(Description::$name);
                })+
                Rig::parse(text, origin).map(Description::Joint)
            }

            /// Turns a recording into SI quantities; `origin` is the file that messages name.
            ///
            /// # Errors
            /// A channel of the rig is missing, or its unit in the header does not convert to the rig's.
            pub fn apply(&self, trace: &Trace, origin: &Path) -> Result<Measured, TraceError> {
                self.taken(trace.clone(), origin)
            }

            /// The same of a recording that nobody needs afterwards: its numbers are turned where they stand.
            ///
            /// # Errors
            /// As [`Description::apply`].
            pub fn taken(&self, trace: Trace, origin: &Path) -> Result<Measured, TraceError> {
                match self {
                    $(Description::$name(own) => own.measured(trace, origin).map(Measured::$name),)+
                }
            }

            /// The description with the units that some columns are said to be in, whatever their headers say.
            ///
            /// # Errors
            /// Names a channel that the rig does not have, and those it has.
            pub fn with_column_units(&self, units: &[(String, String)]) -> Result<Description, String> {
                match self {
                    $(Description::$name(own) => own.in_units(units).map(Description::$name),)+
                }
            }

            /// Reads a text recording whose dialect is partly known, and says in which it was, and what was guessed, passed over or mended.
            ///
            /// # Errors
            /// The file cannot be read, or as [`Description::apply`].
            pub fn read_text(&self, file: &Path, hints: &Hints) -> Result<(Measured, Dialect, Vec<String>), TraceError> {
                match self {
                    $(Description::$name(own) => {
                        own.read_csv(file, hints)
                            .map(|(recording, dialect, remarks)| (Measured::$name(recording), dialect, remarks))
                    })+
                }
            }

            /// Reads an MCAP recording, and says how it was read.
            ///
            /// # Errors
            /// The file cannot be read, or as [`Description::apply`].
            pub fn read_mcap(&self, file: &Path) -> Result<(Measured, Vec<String>), TraceError> {
                match self {
                    $(Description::$name(own) => {
                        own.read_messages(file).map(|(recording, lines)| (Measured::$name(recording), lines))
                    })+
                }
            }

            /// Diagnoses recordings of this rig together; `held_out` is another one. `None` where one is of another plant.
            pub fn diagnose(
                &self,
                recordings: &[Measured],
                held_out: Option<&Measured>,
                options: &Options,
            ) -> Option<Diagnosis> {
                match self {
                    $(Description::$name(own) => {
                        let of = |recording| match recording {
                            &Measured::$name(ref recording) => Some(recording),
                            _ => None,
                        };
                        let all = recordings.iter().map(of).collect::<Option<Vec<_>>>()?;
                        let held_out = match held_out {
                            Some(held_out) => Some(of(held_out)?),
                            None => None,
                        };
                        Some(diagnose(own, &all, held_out, options).map(Description::$name))
                    })+
                }
            }

            /// What a rig with the numbers of `model` would have recorded.
            ///
            /// # Errors
            /// Why it cannot be simulated.
            pub fn replica(&self, model: &Description, recording: &Measured) -> Result<Replica, String> {
                match (self, model, recording) {
                    $((Description::$name(own), Description::$name(model), Measured::$name(recording)) => {
                        let replica = own.replica(model, recording)?;
                        Ok(Replica {
                            recording: Measured::$name(replica.recording),
                            noise: replica.noise,
                            how: replica.how,
                        })
                    })+
                    _ => Err("the recording is one of another plant".to_owned()),
                }
            }

            /// A model beside a recording; where it runs freely it starts from the recorded state every `restart_s`.
            ///
            /// # Errors
            /// The recording is at fault, or the model cannot be simulated.
            pub fn simulated(
                &self,
                model: &Description,
                recording: &Measured,
                restart_s: f64,
            ) -> Result<Simulated, Unsimulated> {
                match (self, model, recording) {
                    $((Description::$name(own), Description::$name(model), Measured::$name(recording)) => {
                        own.simulated(model, recording, restart_s)
                    })+
                    _ => Err(Unsimulated::Model("the recording is one of another plant".to_owned())),
                }
            }

            /// Why a calibration is none of this rig; `None` if it is one.
            pub fn refuses(&self, calibration: &Description) -> Option<String> {
                match (self, calibration) {
                    $((Description::$name(own), Description::$name(calibration)) => own.refuses(Some(calibration)),)+
                    $((Description::$name(own), _) => own.refuses(None),)+
                }
            }

            /// The end of a recording beside free runs of this description and another one; `None` where the plant has no such picture.
            pub fn replay(&self, after: &Description, recording: &Measured) -> Option<Replayed> {
                match (self, after, recording) {
                    $((Description::$name(own), Description::$name(after), Measured::$name(recording)) => {
                        own.replay(after, recording)
                    })+
                    _ => None,
                }
            }

            /// A calibration without what was found: this one is nominal.
            pub fn without_found(&self, calibration: &Description) -> Description {
                match (self, calibration) {
                    $((Description::$name(own), Description::$name(calibration)) => {
                        Description::$name(own.without_found(calibration))
                    })+
                    (_, other) => other.clone(),
                }
            }

            /// It in formats of other programs: names of files and their texts.
            pub fn beside(&self) -> Vec<(&'static str, String)> {
                match self {
                    $(Description::$name(own) => own.beside(),)+
                }
            }

            /// As TOML.
            pub fn to_toml(&self) -> String {
                match self {
                    $(Description::$name(own) => own.written(),)+
                }
            }
        }

        impl Measured {
            /// The time stamps, s.
            pub fn time_s(&self) -> &[f64] {
                match self {
                    $(Measured::$name(own) => <$plant>::times_s(own),)+
                }
            }

            /// The samples that are kept.
            pub fn only(&self, kept: &[bool]) -> Measured {
                match self {
                    $(Measured::$name(own) => Measured::$name(<$plant>::only(own, kept)),)+
                }
            }

            /// The recording with fresh noise, in counts.
            pub(crate) fn sensed(&self, noise: [f64; 2], random: &mut Pcg64Mcg) -> Measured {
                match self {
                    $(Measured::$name(own) => Measured::$name(<$plant>::sensed(own, noise, random)),)+
                }
            }
        }
    };
}

// The first that a text describes takes it.
plants! {
    #[doc = "The five-bar."] FiveBar(FiveBar),
    #[doc = "A serial arm."] Chain(ChainRig),
    #[doc = "A plant of one joint."] Joint(Rig),
}

impl Description {
    /// Reads a description of any plant from a TOML file.
    ///
    /// # Errors
    /// The file cannot be read, or as [`Description::parse`].
    pub fn read(path: &Path) -> Result<Description, TraceError> {
        Description::parse(&store::read_text(path)?, path)
    }
}
