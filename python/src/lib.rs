//! This file is the compiled part of the Python package; without the feature `extension` it is empty.

#[cfg(feature = "extension")]
mod extension;
