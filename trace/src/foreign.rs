//! This file names files of other kinds by their first bytes, and the way in for each.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use crate::error::TraceError;

/// Bytes that are looked at.
const START: u64 = 8192;

/// A kind of file: what it begins with, what it is called, and the way in, in which `IN` and `OUT` stand for the names of
/// the file and of what it becomes.
struct Kind {
    start: &'static [u8],
    name: &'static str,
    way: &'static str,
}

const KINDS: [Kind; 20] = [
    kind(
        b"#ROSBAG V2.0",
        "a bag of ROS 1",
        "turn it into MCAP, which is read: `mcap convert IN OUT.mcap` (the `mcap` program), or `rosbags-convert --src IN --dst OUT` (pip install rosbags)",
    ),
    kind(
        b"SQLite format 3\0",
        "an SQLite file, as rosbag2 writes (`.db3`)",
        "turn it into MCAP, which is read: `mcap convert IN OUT.mcap` (the `mcap` program)",
    ),
    kind(
        b"TDSm",
        "a TDMS file of LabVIEW",
        "turn it into text: python3 -c \"from nptdms import TdmsFile; TdmsFile.read('IN').as_dataframe(time_index=True).to_csv('OUT.csv', index_label='time (s)')\" (pip install npTDMS pandas)",
    ),
    kind(
        b"\x93NUMPY",
        "an array of numpy (`.npy`)",
        "turn it into text and name its columns: python3 -c \"import numpy; numpy.savetxt('OUT.csv', numpy.load('IN'), delimiter=',', header='t,q,u', comments='')\"",
    ),
    kind(
        b"PAR1",
        "a Parquet file",
        "turn it into text: python3 -c \"import pandas; pandas.read_parquet('IN').to_csv('OUT.csv')\" (pip install pandas pyarrow)",
    ),
    kind(
        b"ARROW1",
        "a Feather file",
        "turn it into text: python3 -c \"import pandas; pandas.read_feather('IN').to_csv('OUT.csv')\" (pip install pandas pyarrow)",
    ),
    kind(
        b"ULog\x01\x12\x35",
        "a ULog file of PX4",
        "turn it into text: `ulog2csv IN` writes a table for each topic (pip install pyulog)",
    ),
    kind(
        b"MDF     ",
        "an MDF file (`.mf4`, `.dat`)",
        "turn it into text: python3 -c \"from asammdf import MDF; MDF('IN').to_dataframe().to_csv('OUT.csv', index_label='time (s)')\" (pip install asammdf)",
    ),
    kind(
        b"UnFinMF ",
        "an MDF file that was not finished",
        "finish it and turn it into text: python3 -c \"from asammdf import MDF; MDF('IN').to_dataframe().to_csv('OUT.csv', index_label='time (s)')\" (pip install asammdf)",
    ),
    kind(
        b"\x28\xb5\x2f\xfd",
        "a file compressed with zstd",
        "unpack it: `zstd -d IN`",
    ),
    kind(
        b"BZh",
        "a file compressed with bzip2",
        "unpack it: `bunzip2 -k IN`",
    ),
    kind(
        b"\xfd7zXZ\0",
        "a file compressed with xz",
        "unpack it: `unxz -k IN`",
    ),
    kind(
        b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1",
        "a workbook of an old Excel",
        "save the sheet as CSV, or: python3 -c \"import pandas; pandas.read_excel('IN').to_csv('OUT.csv', index=False)\" (pip install pandas xlrd)",
    ),
    kind(
        b"\x80\x04\x95",
        "a pickle of Python",
        "turn it into text: python3 -c \"import pandas; pandas.read_pickle('IN').to_csv('OUT.csv')\"",
    ),
    kind(
        b"\x80\x05\x95",
        "a pickle of Python",
        "turn it into text: python3 -c \"import pandas; pandas.read_pickle('IN').to_csv('OUT.csv')\"",
    ),
    kind(
        b"\x89HDF\r\n\x1a\n",
        "an HDF5 file, or MATLAB of version 7.3",
        "it does not say which array is the time; look with `rigproof convert --list IN`, then take out what is needed: `rigproof convert IN OUT.csv --variables NAMES --time-from NAME`",
    ),
    kind(
        b"MATLAB 5.0",
        "a MATLAB file",
        "it does not say which array is the time; look with `rigproof convert --list IN`, then take out what is needed: `rigproof convert IN OUT.csv --variables NAMES --time-from NAME`",
    ),
    kind(
        b"\x89MCAP0\r\n",
        "an MCAP file",
        "take its numbers out: `rigproof convert IN OUT.csv`",
    ),
    kind(
        b"RIFF",
        "a sound file",
        "turn it into text: python3 -c \"import numpy, scipy.io.wavfile as w; r, x = w.read('IN'); numpy.savetxt('OUT.csv', numpy.column_stack([numpy.arange(len(x)) / r, x]), delimiter=',', header='t', comments='')\"",
    ),
    kind(
        b"%PDF",
        "a PDF document",
        "a table in it is no recording; ask for the numbers as text",
    ),
];

const fn kind(start: &'static [u8], name: &'static str, way: &'static str) -> Kind {
    Kind { start, name, way }
}

/// Refuses a file that begins like one of another kind.
///
/// # Errors
/// It does, or it cannot be read; the message says what it is and how to bring it in.
pub fn check(path: &Path) -> Result<(), TraceError> {
    let mut start = Vec::new();
    File::open(path)
        .and_then(|file| file.take(START).read_to_end(&mut start))
        .map_err(TraceError::io("read", path))?;
    match of(&start) {
        Some((kind, way)) => Err(TraceError::OtherKind {
            file: path.to_path_buf(),
            kind,
            way: named(way, path),
        }),
        None => Ok(()),
    }
}

/// The kind of a file that begins so, and the way in.
fn of(start: &[u8]) -> Option<(&'static str, &'static str)> {
    let known = KINDS.iter().find(|kind| start.starts_with(kind.start));
    known
        .map(|kind| (kind.name, kind.way))
        .or_else(|| zip(start))
        .or_else(|| matlab4(start))
        .or_else(|| json(start))
}

/// What a ZIP archive holds.
fn zip(start: &[u8]) -> Option<(&'static str, &'static str)> {
    if !start.starts_with(b"PK\x03\x04") {
        return None;
    }
    let holds = |part: &[u8]| start.windows(part.len()).any(|window| window == part);
    Some(if holds(b".npy") {
        (
            "an archive of numpy (`.npz`)",
            "turn it into text: python3 -c \"import numpy; d = numpy.load('IN'); k = [n for n in d if d[n].ndim == 1]; numpy.savetxt('OUT.csv', numpy.column_stack([d[n] for n in k]), delimiter=',', header=','.join(k), comments='')\"",
        )
    } else if holds(b"xl/") || holds(b"[Content_Types].xml") {
        (
            "a workbook of Excel (`.xlsx`)",
            "save the sheet as CSV, or: python3 -c \"import pandas; pandas.read_excel('IN').to_csv('OUT.csv', index=False)\" (pip install pandas openpyxl)",
        )
    } else if holds(b"opendocument.spreadsheet") {
        (
            "a spreadsheet of LibreOffice (`.ods`)",
            "save the sheet as CSV, or: `libreoffice --headless --convert-to csv IN`",
        )
    } else {
        ("a ZIP archive", "unpack it: `unzip IN`")
    })
}

/// MATLAB of version 4 has no mark: five small numbers and a name stand first.
fn matlab4(start: &[u8]) -> Option<(&'static str, &'static str)> {
    let number = |at: usize| {
        let bytes = start.get(at..at + 4)?.first_chunk::<4>()?;
        let [little, big] = [u32::from_le_bytes(*bytes), u32::from_be_bytes(*bytes)];
        Some(little.min(big))
    };
    let (kind, rows, columns) = (number(0)?, number(4)?, number(8)?);
    let (imaginary, length) = (number(12)?, number(16)?);
    let digits = [kind / 1000, kind / 100 % 10, kind / 10 % 10, kind % 10];
    let [order, zero, precision, matrix] = digits;
    let is_kind = order < 5 && zero == 0 && precision < 6 && matrix < 3 && imaginary < 2;
    let size = usize::try_from(length).ok()?;
    let name = start.get(20..20 + size.checked_sub(1)?)?;
    let is_name = !name.is_empty() && name.iter().all(|b| b.is_ascii_alphanumeric() || *b == b'_');
    (is_kind && is_name && rows > 0 && columns > 0 && start.get(19 + size) == Some(&0)).then_some((
        "a MATLAB file of version 4",
        "save it again: in MATLAB `load('IN'); save('OUT.mat', '-v7')`, or python3 -c \"import scipy.io as s; d = s.loadmat('IN'); s.savemat('OUT.mat', {k: d[k] for k in d if k[0] != '_'})\"; then `rigproof convert --list OUT.mat`",
    ))
}

/// Text that begins as JSON does.
fn json(start: &[u8]) -> Option<(&'static str, &'static str)> {
    let text = start
        .strip_prefix(b"\xef\xbb\xbf")
        .unwrap_or(start)
        .trim_ascii_start();
    let second = text.get(1..).unwrap_or_default().trim_ascii_start();
    let is_json = match text.first()? {
        b'{' => matches!(second.first(), Some(b'"' | b'}')),
        b'[' => matches!(second.first(), Some(b'{' | b'[')),
        _ => false,
    };
    is_json.then_some((
        "a JSON file",
        "turn its list of samples into text: python3 -c \"import json, pandas; d = json.load(open('IN')); d = d if isinstance(d, list) else max((v for v in d.values() if isinstance(v, list)), key=len, default=[d]); pandas.json_normalize(d).to_csv('OUT.csv', index=False)\" (pip install pandas)",
    ))
}

/// The way in with the names of the file.
fn named(way: &str, path: &Path) -> String {
    let plain = |text: String| {
        let harmless = text
            .chars()
            .all(|c| c.is_alphanumeric() || "/._- ".contains(c));
        harmless.then_some(text)
    };
    let name = plain(path.display().to_string()).unwrap_or_else(|| "FILE".to_owned());
    let stem = path
        .file_stem()
        .map(|stem| stem.to_string_lossy().into_owned());
    let stem = stem.and_then(plain).unwrap_or_else(|| "run".to_owned());
    way.replace("IN", &name).replace("OUT", &stem)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(name: &str, bytes: &[u8]) -> String {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        check(&path).map_or_else(|error| error.to_string(), |()| "text".to_owned())
    }

    #[test]
    fn a_file_of_another_kind_is_named_with_the_way_in() {
        let matlab4 = [
            &[0_u8; 4][..],
            &[30, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0],
            b"q\0",
            &[0; 240],
        ]
        .concat();
        for (name, bytes, kind, way) in [
            (
                "run.bag",
                &b"#ROSBAG V2.0\n\x45\0\0\0"[..],
                "bag of ROS 1",
                "mcap convert",
            ),
            (
                "run.db3",
                b"SQLite format 3\0\x10\0",
                "SQLite",
                "mcap convert",
            ),
            ("run.tdms", b"TDSm\x0e\0\0\0", "TDMS", "nptdms"),
            (
                "run.xlsx",
                b"PK\x03\x04\x14\0\x06\0[Content_Types].xml",
                "Excel",
                "read_excel",
            ),
            (
                "run.npz",
                b"PK\x03\x04\x14\0\0\0t.npy\x93NUMPY",
                "numpy",
                "savetxt('run.csv'",
            ),
            ("run.parquet", b"PAR1\x15\x04", "Parquet", "read_parquet"),
            ("run.ulg", b"ULog\x01\x12\x35\x01", "ULog", "ulog2csv"),
            ("run.mf4", b"MDF     4.10    ", "MDF", "asammdf"),
            (
                "run.json",
                b"{\n \"entries\": [{\"t\": 0.1}]}",
                "JSON",
                "json_normalize",
            ),
            (
                "run.json",
                b"[[0.1, 2.5], [0.2, 3.5]]",
                "JSON",
                "to_csv('run.csv'",
            ),
            ("run.mat", &matlab4, "MATLAB file of version 4", "loadmat"),
            (
                "run.mat",
                b"MATLAB 5.0 MAT-file",
                "MATLAB file",
                "rigproof convert --list",
            ),
            ("run.zst", b"\x28\xb5\x2f\xfd\x04", "zstd", "zstd -d"),
        ] {
            let said = message(name, bytes);
            assert!(
                said.contains(kind) && said.contains(way) && !said.contains('\n'),
                "{said}"
            );
        }
    }

    #[test]
    fn a_text_is_none_of_them() {
        for text in [
            &b"t,x\n0.1,2.5\n"[..],
            b"[s],x\n",
            b"0.1 2.5\n0.2 3.5\n 0.3 4.5\n0.4 4.4\n",
            b"",
        ] {
            assert_eq!(message("run.csv", text), "text");
        }
    }
}
