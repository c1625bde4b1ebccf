//! MATLAB's MAT files, level 5, without compression.
//!
//! A header of 128 bytes, then one element a variable. An element is a type, a length and data up to a multiple of
//! eight bytes; a variable is an element of elements: flags, dimensions, name, real part, imaginary part.

use super::Array;
use crate::error::{Error, Result};

/// Types of elements.
const INT8: u32 = 1;
const UINT8: u32 = 2;
const UINT16: u32 = 4;
const INT32: u32 = 5;
const UINT32: u32 = 6;
const DOUBLE: u32 = 9;
const MATRIX: u32 = 14;

/// Classes of variables, and flags.
const CELL: u32 = 1;
const CHAR: u32 = 4;
const NUMBERS: u32 = 6;
const BYTES: u32 = 9;
const IS_LOGICAL: u32 = 0x200;
const IS_COMPLEX: u32 = 0x800;

/// Largest size of a variable, bytes.
const LARGEST: usize = i32::MAX as usize;

/// The file with these arrays as variables, the same bytes each time. A list is a column.
///
/// # Errors
/// Names that MATLAB does not allow, and variables larger than 2 GiB.
pub fn write(arrays: &[(&str, Array)]) -> Result<Vec<u8>> {
    let mut file = format!("{:<124}", "MATLAB 5.0 MAT-file, written by holonom").into_bytes();
    file.extend([0x00, 0x01, b'I', b'M']);
    for (name, array) in arrays {
        if !is_name(name) {
            return Err(Error::input(format!("`{name}` is no name of a MATLAB variable")));
        }
        let variable = variable(name, array);
        if variable.len() > LARGEST {
            let error = Error::input(format!("`{name}` is too large for a MAT file")).hint("use the .npz file");
            return Err(error);
        }
        file.extend(variable);
    }
    Ok(file)
}

/// True for a name of MATLAB: a letter, then letters, digits and underscores, at most 63 in all.
fn is_name(name: &str) -> bool {
    let is_word = name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    name.starts_with(|c: char| c.is_ascii_alphabetic()) && is_word && name.len() <= 63
}

fn variable(name: &str, array: &Array) -> Vec<u8> {
    match array {
        Array::Flag(flag) => matrix(name, BYTES | IS_LOGICAL, [1, 1], &[element(UINT8, &[u8::from(*flag)])]),
        Array::Real { shape, values } => {
            let size = size(shape);
            matrix(name, NUMBERS, size, &[doubles(size, |i| values[i])])
        }
        Array::Complex { shape, values } => {
            let size = size(shape);
            let parts = [doubles(size, |i| values[i].re), doubles(size, |i| values[i].im)];
            matrix(name, NUMBERS | IS_COMPLEX, size, &parts)
        }
        Array::Text(text) => {
            let letters: Vec<u16> = text.encode_utf16().collect();
            let bytes: Vec<u8> = letters.iter().flat_map(|letter| letter.to_le_bytes()).collect();
            matrix(name, CHAR, [usize::from(!letters.is_empty()), letters.len()], &[element(UINT16, &bytes)])
        }
        Array::Texts(list) => {
            let cells: Vec<Vec<u8>> = list.iter().map(|text| variable("", &Array::Text(text.clone()))).collect();
            matrix(name, CELL, [list.len(), usize::from(!list.is_empty())], &cells)
        }
    }
}

/// Numbers of rows and columns; further dimensions are merged into the columns.
fn size(shape: &[usize]) -> [usize; 2] {
    match *shape {
        [] => [1, 1],
        [rows] => [rows, 1],
        [rows, ref more @ ..] => [rows, more.iter().product()],
    }
}

/// Numbers column by column; `value` takes the row-major index.
fn doubles(size: [usize; 2], value: impl Fn(usize) -> f64) -> Vec<u8> {
    let [rows, columns] = size;
    let places = (0..columns).flat_map(|j| (0..rows).map(move |i| i * columns + j));
    element(DOUBLE, &places.flat_map(|place| value(place).to_le_bytes()).collect::<Vec<u8>>())
}

fn matrix(name: &str, class: u32, size: [usize; 2], contents: &[Vec<u8>]) -> Vec<u8> {
    let [rows, columns] = size;
    let flags = [class.to_le_bytes(), [0; 4]].concat();
    let size = [(rows as i32).to_le_bytes(), (columns as i32).to_le_bytes()].concat();
    let head = [element(UINT32, &flags), element(INT32, &size), element(INT8, name.as_bytes())].concat();
    element(MATRIX, &[head, contents.concat()].concat())
}

fn element(kind: u32, data: &[u8]) -> Vec<u8> {
    let padding = data.len().next_multiple_of(8) - data.len();
    [&kind.to_le_bytes()[..], &(data.len() as u32).to_le_bytes(), data, &[0; 8][..padding]].concat()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Complex;

    /// Type and data of the elements one after another.
    fn elements(mut bytes: &[u8]) -> Vec<(u32, &[u8])> {
        let word = |bytes: &[u8], at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
        let mut found = Vec::new();
        while !bytes.is_empty() {
            let kind = word(bytes, 0);
            let length = word(bytes, 4) as usize;
            found.push((kind, &bytes[8..8 + length]));
            bytes = &bytes[8 + length.next_multiple_of(8)..];
        }
        found
    }

    #[derive(Debug, PartialEq)]
    struct Variable {
        name: String,
        class: u8,
        flags: u8,
        size: [u32; 2],
        numbers: Vec<f64>,
        text: String,
        cells: Vec<String>,
    }

    fn read_variable(data: &[u8]) -> Variable {
        let parts = elements(data);
        let words = |data: &[u8]| -> Vec<u32> {
            data.chunks(4).map(|word| u32::from_le_bytes(word.try_into().unwrap())).collect()
        };
        let size = words(parts[1].1);
        assert_eq!([parts[0].0, parts[1].0, parts[2].0], [UINT32, INT32, INT8]);
        let mut variable = Variable {
            name: String::from_utf8(parts[2].1.to_vec()).unwrap(),
            class: parts[0].1[0],
            flags: parts[0].1[1],
            size: [size[0], size[1]],
            numbers: Vec::new(),
            text: String::new(),
            cells: Vec::new(),
        };
        for (kind, data) in &parts[3..] {
            match *kind {
                DOUBLE => {
                    variable.numbers.extend(data.chunks(8).map(|bytes| f64::from_le_bytes(bytes.try_into().unwrap())))
                }
                UINT8 => variable.numbers.extend(data.iter().map(|byte| f64::from(*byte))),
                UINT16 => {
                    let letters: Vec<u16> = data.chunks(2).map(|b| u16::from_le_bytes(b.try_into().unwrap())).collect();
                    variable.text = String::from_utf16(&letters).unwrap();
                }
                MATRIX => variable.cells.push(read_variable(data).text),
                other => panic!("element of type {other}"),
            }
        }
        variable
    }

    fn read(file: &[u8]) -> Vec<Variable> {
        assert_eq!((&file[..19], &file[124..128]), (&b"MATLAB 5.0 MAT-file"[..], &[0, 1, b'I', b'M'][..]));
        elements(&file[128..]).iter().map(|(_, data)| read_variable(data)).collect()
    }

    #[test]
    fn arrays_come_back() {
        let complex = vec![Complex::new(-1.0, 2.0), Complex::new(f64::INFINITY, 0.0)];
        let file = write(&[
            ("t", Array::number(0.25)),
            ("equilibrium", Array::Flag(true)),
            ("A", Array::Real { shape: vec![2, 3], values: vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0] }),
            ("B", Array::Real { shape: vec![2, 0], values: Vec::new() }),
            ("eigenvalues", Array::complex(complex)),
            ("method", Array::Text("mcs: φ".to_string())),
            ("states", Array::Texts(vec!["crank.angle".to_string(), String::new()])),
            ("inputs", Array::Texts(Vec::new())),
        ])
        .unwrap();
        assert_eq!(file.len() % 8, 0);
        let variables = read(&file);
        let find = |name: &str| variables.iter().find(|variable| variable.name == name).unwrap();
        assert_eq!((find("t").class, find("t").size, &find("t").numbers[..]), (6, [1, 1], &[0.25][..]));
        assert_eq!((find("equilibrium").class, find("equilibrium").flags), (9, 2));
        assert_eq!((find("A").size, &find("A").numbers[..]), ([2, 3], &[1.0, 4.0, 2.0, 5.0, 3.0, 6.0][..]));
        assert_eq!((find("B").size, find("B").numbers.len()), ([2, 0], 0));
        let eigenvalues = find("eigenvalues");
        assert_eq!((eigenvalues.class, eigenvalues.flags, eigenvalues.size), (6, 8, [2, 1]));
        assert_eq!(eigenvalues.numbers, [-1.0, f64::INFINITY, 2.0, 0.0]);
        assert_eq!((find("method").class, find("method").size, find("method").text.as_str()), (4, [1, 6], "mcs: φ"));
        assert_eq!((find("states").class, find("states").size), (1, [2, 1]));
        assert_eq!((find("states").cells.len(), find("states").cells[0].as_str()), (2, "crank.angle"));
        assert_eq!((find("inputs").size, find("inputs").cells.len()), ([0, 0], 0));
    }

    #[test]
    fn names_are_those_of_matlab() {
        for name in ["", "1a", "a.b", "a'", "_a", &"a".repeat(64)] {
            assert!(write(&[(name, Array::Flag(true))]).is_err(), "{name}");
        }
    }
}
