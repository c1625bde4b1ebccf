//! NumPy's `.npy` format: a header with type and shape, then the bytes of the items.

use crate::error::{Error, Result};

const MAGIC: &[u8] = b"\x93NUMPY";

/// One array whose items are still bytes.
pub struct Npy<'a> {
    /// Lengths of the dimensions; empty for a single number.
    pub shape: Vec<usize>,
    /// NumPy's name of the type, such as `<f8`.
    descr: String,
    /// Bytes of one item.
    size: usize,
    /// True if the first index runs fastest (Fortran order).
    fortran: bool,
    data: &'a [u8],
}

impl<'a> Npy<'a> {
    /// # Errors
    /// Bad input: another format, a header that does not say what it must, or an array cut short.
    pub fn parse(bytes: &'a [u8]) -> Result<Self> {
        let (header, data) = split(bytes).ok_or_else(|| Error::input("not an .npy file, or cut short"))?;
        let descr = value(header, "descr")?;
        let descr = descr.strip_prefix('\'').and_then(|rest| rest.split_once('\'')).map(|(name, _)| name.to_string());
        let descr = descr.ok_or_else(|| Error::input("expected an array of one type, found a structured one"))?;
        let size = item_size(&descr).ok_or_else(|| other("numbers or text", &descr))?;
        let shape = shape(value(header, "shape")?)?;
        let fortran = value(header, "fortran_order")?.starts_with("True");
        let expected = shape.iter().try_fold(size, |product, &length| product.checked_mul(length));
        if expected != Some(data.len()) {
            return Err(Error::input(format!("{} bytes do not make shape {shape:?} of type {descr}", data.len())));
        }
        Ok(Npy { shape, descr, size, fortran, data })
    }

    /// # Errors
    /// Bad input: an array of something else.
    pub fn numbers(&self) -> Result<Vec<f64>> {
        let bits = 64 - 8 * self.size.min(8);
        let number: fn(u64, usize) -> f64 = match self.descr.get(1..) {
            Some("f8") => |raw, _| f64::from_bits(raw),
            Some("f4") => |raw, _| f64::from(f32::from_bits(raw as u32)),
            // Shifted up and down again, the sign fills the bits before it.
            Some("i8" | "i4" | "i2" | "i1") => |raw, bits| ((raw << bits) as i64 >> bits) as f64,
            Some("u8" | "u4" | "u2" | "u1" | "b1") => |raw, _| raw as f64,
            _ => return Err(other("numbers", &self.descr).hint("convert it by .astype(float)")),
        };
        Ok(self.items().map(|item| number(self.raw(item), bits)).collect())
    }

    /// # Errors
    /// Bad input: an array of something else, or of what is not Unicode.
    pub fn texts(&self) -> Result<Vec<String>> {
        if self.descr.get(1..2) != Some("U") {
            return Err(other("text", &self.descr));
        }
        let text = |item: &[u8]| {
            let letters = item.chunks_exact(4).map(|letter| char::from_u32(self.raw(letter) as u32));
            let text = letters.collect::<Option<String>>()?;
            Some(text.trim_end_matches('\0').to_string())
        };
        self.items().map(text).collect::<Option<_>>().ok_or_else(|| Error::input("holds text that is not Unicode"))
    }

    /// The bytes of the items, the last index running fastest.
    fn items(&self) -> impl Iterator<Item = &[u8]> {
        let count = self.data.len() / self.size;
        (0..count).map(|i| {
            let place = if self.fortran { fortran_place(&self.shape, i) } else { i };
            &self.data[place * self.size..(place + 1) * self.size]
        })
    }

    /// Up to eight bytes as an integer, in the byte order of the type.
    fn raw(&self, bytes: &[u8]) -> u64 {
        let append = |raw, byte: &u8| raw << 8 | u64::from(*byte);
        if self.descr.starts_with('>') { bytes.iter().fold(0, append) } else { bytes.iter().rev().fold(0, append) }
    }
}

fn other(expected: &str, descr: &str) -> Error {
    Error::input(format!("expected {expected}, found an array of type {descr}"))
}

/// Header and data. The length of the header has two bytes in version 1 and four later.
fn split(bytes: &[u8]) -> Option<(&str, &[u8])> {
    let (version, rest) = bytes.strip_prefix(MAGIC)?.split_at_checked(2)?;
    let (length, rest) = rest.split_at_checked(if version[0] == 1 { 2 } else { 4 })?;
    let length = length.iter().rev().fold(0, |length, byte| length << 8 | usize::from(*byte));
    let (header, data) = rest.split_at_checked(length)?;
    Some((std::str::from_utf8(header).ok()?, data))
}

/// Text after a key in the header, which is a Python dictionary.
fn value<'a>(header: &'a str, key: &str) -> Result<&'a str> {
    let found = header.split_once(&format!("'{key}':")).map(|(_, rest)| rest.trim_start());
    found.ok_or_else(|| Error::input(format!("the header of the array does not say `{key}`")))
}

/// Parses a shape such as `(3, 4)`, `(3,)` or `()`.
fn shape(text: &str) -> Result<Vec<usize>> {
    let inside = text.strip_prefix('(').and_then(|rest| rest.split_once(')')).map(|(inside, _)| inside);
    let lengths = |inside: &str| {
        let lengths = inside.split(',').map(str::trim).filter(|length| !length.is_empty());
        lengths.map(|length| length.parse().ok()).collect::<Option<_>>()
    };
    inside.and_then(lengths).ok_or_else(|| Error::input("the header of the array gives no shape"))
}

/// Bytes of an item; none for objects, dates and other types without a plain size.
fn item_size(descr: &str) -> Option<usize> {
    let kind = descr.strip_prefix(['<', '>', '|'])?;
    let size = kind.get(1..)?.parse::<usize>().ok().filter(|size| *size > 0)?;
    // A letter has four bytes.
    if kind.starts_with('U') { size.checked_mul(4) } else { Some(size) }
}

/// Place in Fortran order of the item with row-major index `index`.
fn fortran_place(shape: &[usize], mut index: usize) -> usize {
    let mut place = 0;
    // Digits of the index from the last one on, weighed by what comes before each.
    for (k, length) in shape.iter().enumerate().rev() {
        place += index % length * shape[..k].iter().product::<usize>();
        index /= length;
    }
    place
}
