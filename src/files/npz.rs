//! NumPy's `.npz` files: a zip archive with one `.npy` file for each array, as `numpy.savez` writes it.

use super::Array;
use crate::error::{Error, Result};
use std::io::{Cursor, Write};
use std::path::Path;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipArchive, ZipWriter};

/// An archive that is read.
pub type Archive = ZipArchive<Cursor<Vec<u8>>>;

/// Opens a file.
///
/// # Errors
/// A file that cannot be read or is no archive.
pub fn open(path: &Path) -> Result<Archive> {
    let file = super::read(path).map_err(|problem| Error::input(problem.to_string()))?;
    ZipArchive::new(Cursor::new(file))
        .map_err(|problem| Error::input(problem.to_string()).hint("write it by numpy.savez"))
}

/// Contents of the `.npy` file of one array, if there is one.
///
/// # Errors
/// An archive that is damaged, and an array of more than 256 MB.
pub fn member(archive: &mut Archive, key: &str) -> Result<Option<Vec<u8>>> {
    let problem = match archive.by_name(&format!("{key}.npy")) {
        Ok(file) => match super::read_limited(file) {
            Ok(bytes) => return Ok(Some(bytes)),
            Err(problem) => problem.to_string(),
        },
        Err(zip::result::ZipError::FileNotFound) => return Ok(None),
        Err(problem) => problem.to_string(),
    };
    Err(Error::input(problem).under(key))
}

/// The file with these arrays under their names, the same bytes each time.
///
/// # Errors
/// Names that an archive cannot have, such as one twice.
pub fn write(arrays: &[(&str, Array)]) -> Result<Vec<u8>> {
    let failed = |problem: String| Error::input(format!("cannot write the arrays: {problem}"));
    // The first date that zip knows, so that the file depends on its contents alone.
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Stored)
        .last_modified_time(DateTime::default());
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, array) in arrays {
        archive.start_file(format!("{name}.npy"), options).map_err(|problem| failed(problem.to_string()))?;
        archive.write_all(&npy(array)).map_err(|problem| failed(problem.to_string()))?;
    }
    archive.finish().map(Cursor::into_inner).map_err(|problem| failed(problem.to_string()))
}

/// One array as an `.npy` file.
fn npy(array: &Array) -> Vec<u8> {
    match array {
        Array::Flag(flag) => file("|b1", &[], &[u8::from(*flag)]),
        Array::Real { shape, values } => file("<f8", shape, &doubles(values.iter().copied())),
        Array::Complex { shape, values } => {
            file("<c16", shape, &doubles(values.iter().flat_map(|value| [value.re, value.im])))
        }
        Array::Text(text) => texts(&[], std::slice::from_ref(text)),
        Array::Texts(list) => texts(&[list.len()], list),
    }
}

fn doubles(values: impl Iterator<Item = f64>) -> Vec<u8> {
    values.flat_map(f64::to_le_bytes).collect()
}

/// Texts as code points of four bytes, filled up to the longest; NumPy knows none of length zero.
fn texts(shape: &[usize], list: &[String]) -> Vec<u8> {
    let longest = list.iter().map(|text| text.chars().count()).max().unwrap_or(0).max(1);
    let filled = |text: &String| {
        let letters = text.chars().map(u32::from).chain(std::iter::repeat(0));
        letters.take(longest).flat_map(u32::to_le_bytes).collect::<Vec<u8>>()
    };
    file(&format!("<U{longest}"), shape, &list.iter().flat_map(filled).collect::<Vec<u8>>())
}

/// Version 1: magic, length of the header in two bytes, the header as a Python dictionary, data from a multiple of 64.
fn file(descr: &str, shape: &[usize], data: &[u8]) -> Vec<u8> {
    const START: usize = 10;
    let lengths: Vec<String> = shape.iter().map(usize::to_string).collect();
    let comma = if shape.len() == 1 { "," } else { "" };
    let header = format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': ({}{comma}), }}", lengths.join(", "));
    let padding = 63 - (START + header.len()) % 64;
    let length = (header.len() + padding + 1) as u16;
    let header = format!("{header}{}\n", " ".repeat(padding));
    [b"\x93NUMPY\x01\x00", &length.to_le_bytes()[..], header.as_bytes(), data].concat()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::npy::Npy;
    use nalgebra::Complex;
    use std::io::Read;

    fn samples() -> Vec<(&'static str, Array)> {
        vec![
            ("t", Array::number(0.1)),
            ("equilibrium", Array::Flag(true)),
            ("A", Array::Real { shape: vec![2, 3], values: vec![1.0, 2.0, 3.0, 4.0, 5.0, f64::INFINITY] }),
            ("empty", Array::Real { shape: vec![0, 2], values: Vec::new() }),
            ("eigenvalues", Array::complex(vec![Complex::new(-1.0, 2.0)])),
            ("method", Array::Text("rcs:form=index2".to_string())),
            ("states", Array::Texts(vec!["crank.angle".to_string(), "φ".to_string()])),
            ("inputs", Array::Texts(Vec::new())),
        ]
    }

    fn member(file: &[u8], name: &str) -> Vec<u8> {
        let mut archive = zip::ZipArchive::new(Cursor::new(file)).unwrap();
        let mut bytes = Vec::new();
        archive.by_name(&format!("{name}.npy")).unwrap().read_to_end(&mut bytes).unwrap();
        bytes
    }

    #[test]
    fn arrays_come_back() {
        let file = write(&samples()).unwrap();
        let numbers = |name: &str| {
            let bytes = member(&file, name);
            let npy = Npy::parse(&bytes).unwrap();
            (npy.numbers().unwrap(), npy.shape)
        };
        assert_eq!(numbers("t"), (vec![0.1], vec![]));
        assert_eq!(numbers("equilibrium"), (vec![1.0], vec![]));
        assert_eq!(numbers("A"), (vec![1.0, 2.0, 3.0, 4.0, 5.0, f64::INFINITY], vec![2, 3]));
        assert_eq!(numbers("empty"), (vec![], vec![0, 2]));
        let texts = |name: &str| Npy::parse(&member(&file, name)).unwrap().texts().unwrap();
        assert_eq!(texts("method"), ["rcs:form=index2"]);
        assert_eq!(texts("states"), ["crank.angle", "φ"]);
        assert_eq!(texts("inputs"), [""; 0]);
    }

    #[test]
    fn bytes_are_those_of_numpy() {
        let complex = member(&write(&samples()).unwrap(), "eigenvalues");
        let header = b"{'descr': '<c16', 'fortran_order': False, 'shape': (1,), }";
        assert_eq!(&complex[..10], b"\x93NUMPY\x01\x00\x76\x00");
        assert_eq!(&complex[10..10 + header.len()], header);
        assert!(complex[10 + header.len()..127].iter().all(|byte| *byte == b' '));
        assert_eq!(complex[127..], [&b"\n"[..], &(-1f64).to_le_bytes(), &2f64.to_le_bytes()].concat());
    }

    #[test]
    fn the_same_contents_make_the_same_bytes() {
        let file = write(&samples()).unwrap();
        assert_eq!(file, write(&samples()).unwrap());
        // Date and time in the header of the first member: midnight, 1 January 1980.
        assert_eq!(file[10..14], [0, 0, 0x21, 0]);
    }

    #[test]
    fn a_name_twice_is_refused() {
        assert!(write(&[("a", Array::Flag(true)), ("a", Array::Flag(true))]).is_err());
    }
}
