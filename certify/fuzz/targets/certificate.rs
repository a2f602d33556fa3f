//! This file feeds bytes to the readers of certificates, findings, worst cases and journals; what is a certificate by its form is sealed, so that what lies behind the digest is reached too.
#![no_main]

use std::path::Path;

use libfuzzer_sys::fuzz_target;
use rigproof_certify::certificate::Certificate;
use rigproof_certify::finding::Finding;
use rigproof_certify::journal;
use rigproof_certify::search::Worst;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(text) = std::str::from_utf8(bytes) {
        let file = Path::new("certificate.json");
        for text in [Some(text.to_owned()), sealed(text)].into_iter().flatten() {
            match Certificate::parse(&text, file) {
                Ok(read) => assert_eq!(read.may_go(), read.may_go_on_the_rig),
                Err(error) => assert!(error.to_string().starts_with("certificate.json")),
            }
        }
        let _ = Finding::parse(text, file);
        let _ = Worst::parse(text, file);
    }
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join(journal::FILE), bytes).unwrap();
    let _ = journal::read(folder.path());
});

fn sealed(text: &str) -> Option<String> {
    let read: Certificate = serde_json::from_str(text).ok()?;
    read.sealed().ok()?.to_json().ok()
}
