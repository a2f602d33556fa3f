//! This file joins the tests that read whole files in one program; the one that measures the memory of its process stands alone.

#[path = "../chunked/mod.rs"]
mod chunked;
mod mcap_damage;
mod mcap_protobuf;
mod mcap_public;
mod mcap_python;
mod readers;
