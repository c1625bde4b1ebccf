//! NumPy's files of one array: all versions, types and orders; what is none.

use crate::files::npy::Npy;

/// A file as NumPy writes it.
pub fn npy(version: u8, descr: &str, fortran: bool, shape: &[usize], data: &[u8]) -> Vec<u8> {
    let lengths: String = shape.iter().map(|length| format!("{length}, ")).collect();
    let order = if fortran { "True" } else { "False" };
    raw(version, &format!("{{'descr': '{descr}', 'fortran_order': {order}, 'shape': ({lengths}), }}"), data)
}

fn raw(version: u8, header: &str, data: &[u8]) -> Vec<u8> {
    let start = if version == 1 { 10 } else { 12 };
    let padding = " ".repeat(63 - (start + header.len()) % 64);
    let header = format!("{header}{padding}\n");
    let length = u32::try_from(header.len()).unwrap().to_le_bytes();
    let length = if version == 1 { &length[..2] } else { &length[..] };
    [b"\x93NUMPY", &[version, 0][..], length, header.as_bytes(), data].concat()
}

pub fn bytes<T: Copy, const N: usize>(values: &[T], to_bytes: fn(T) -> [u8; N]) -> Vec<u8> {
    values.iter().flat_map(|value| to_bytes(*value)).collect()
}

fn numbers(file: &[u8]) -> Vec<f64> {
    Npy::parse(file).unwrap().numbers().unwrap()
}

#[test]
fn every_version() {
    for version in 1..=3 {
        let file = npy(version, "<f8", false, &[2, 1], &bytes(&[1.5, -2.0], f64::to_le_bytes));
        assert_eq!((Npy::parse(&file).unwrap().shape, numbers(&file)), (vec![2, 1], vec![1.5, -2.0]));
    }
    let number = npy(1, "<f8", false, &[], &0.1f64.to_le_bytes());
    assert_eq!((Npy::parse(&number).unwrap().shape, numbers(&number)), (vec![], vec![0.1]));
}

#[test]
fn every_type_in_both_byte_orders() {
    let read = |descr: &str, data: Vec<u8>| numbers(&npy(1, descr, false, &[2], &data));
    assert_eq!(read(">f8", bytes(&[0.1, -3e300], f64::to_be_bytes)), [0.1, -3e300]);
    assert_eq!(read("<f4", bytes(&[0.5, -0.25], f32::to_le_bytes)), [0.5, -0.25]);
    assert_eq!(read(">f4", bytes(&[0.5, -0.25], f32::to_be_bytes)), [0.5, -0.25]);
    assert_eq!(read("<i8", bytes(&[-3, 1 << 40], i64::to_le_bytes)), [-3.0, (1u64 << 40) as f64]);
    assert_eq!(read(">i8", bytes(&[-3, 1 << 40], i64::to_be_bytes)), [-3.0, (1u64 << 40) as f64]);
    assert_eq!(read("<i4", bytes(&[-3, 70000], i32::to_le_bytes)), [-3.0, 70000.0]);
    assert_eq!(read(">i2", bytes(&[-3, 300], i16::to_be_bytes)), [-3.0, 300.0]);
    assert_eq!(read("|i1", vec![0xff, 1]), [-1.0, 1.0]);
    assert_eq!(read("|u1", vec![0xff, 1]), [255.0, 1.0]);
    assert_eq!(read("<u8", bytes(&[u64::MAX, 1], u64::to_le_bytes)), [u64::MAX as f64, 1.0]);
    assert_eq!(read("|b1", vec![0, 1]), [0.0, 1.0]);
}

#[test]
fn text_in_both_byte_orders() {
    let letters: Vec<u32> = "tip\0Rad²".chars().map(u32::from).collect();
    let little = npy(1, "<U4", false, &[2], &bytes(&letters, u32::to_le_bytes));
    let big = npy(1, ">U4", false, &[2], &bytes(&letters, u32::to_be_bytes));
    for file in [little, big] {
        assert_eq!(Npy::parse(&file).unwrap().texts().unwrap(), ["tip", "Rad²"]);
    }
}

#[test]
fn the_first_index_may_run_fastest() {
    // a[i][j][k] = 100 i + 10 j + k
    let shape = [2, 3, 4];
    let mut c = Vec::new();
    let mut fortran = Vec::new();
    (0..24).for_each(|n| c.push(n / 12 * 100 + n / 4 % 3 * 10 + n % 4));
    (0..24).for_each(|n| fortran.push(n % 2 * 100 + n / 2 % 3 * 10 + n / 6));
    let read = |order, values: &[i32]| numbers(&npy(1, "<i4", order, &shape, &bytes(values, i32::to_le_bytes)));
    assert_eq!(read(true, &fortran), read(false, &c));
}

#[test]
fn what_is_no_array_of_numbers() {
    let says = |file: &[u8], expected: &str| {
        let error = Npy::parse(file).and_then(|npy| npy.numbers()).unwrap_err().to_string();
        assert_eq!(error, expected);
    };
    let none = "not an .npy file, or cut short";
    let whole = npy(1, "<f8", false, &[2], &[0; 16]);
    [&b""[..], b"PK", b"\x93NUMPY", &whole[..9], &whole[..40]].iter().for_each(|file| says(file, none));
    says(&whole[..whole.len() - 1], "15 bytes do not make shape [2] of type <f8");
    says(
        &npy(1, "<f8", false, &[usize::MAX, 2], &[]),
        &format!("0 bytes do not make shape [{}, 2] of type <f8", usize::MAX),
    );
    for descr in ["<c16", "<f2", "<U4", "|S4"] {
        let size = if descr == "<f2" {
            2
        } else if descr == "|S4" {
            4
        } else {
            16
        };
        let expected =
            format!("expected numbers, found an array of type {descr}\n  help: convert it by .astype(float)");
        says(&npy(1, descr, false, &[], &vec![0; size]), &expected);
    }
    for descr in ["|O", "<M8[ns]", "", "f8", "<f0"] {
        says(&npy(1, descr, false, &[], &[]), &format!("expected numbers or text, found an array of type {descr}"));
    }
    let header = |text: &str, expected: &str| says(&raw(1, text, &[]), expected);
    header("{}", "the header of the array does not say `descr`");
    header("{'descr': '<f8'}", "the header of the array does not say `shape`");
    header("{'descr': '<f8', 'shape': (2, x)}", "the header of the array gives no shape");
    header("{'descr': '<f8', 'shape': (0,)}", "the header of the array does not say `fortran_order`");
    header("{'descr': [('a', '<f8')]}", "expected an array of one type, found a structured one");

    let file = npy(1, "<f8", false, &[1], &[0; 8]);
    let error = Npy::parse(&file).unwrap().texts().unwrap_err();
    assert_eq!(error.to_string(), "expected text, found an array of type <f8");
    let file = npy(1, "<U1", false, &[1], &[0xff; 4]);
    assert_eq!(Npy::parse(&file).unwrap().texts().unwrap_err().to_string(), "holds text that is not Unicode");
}
