//! Changes of a scene as a file of bytes.

use crate::random::Random;
use crate::words;

pub fn damage(mut text: Vec<u8>, random: &mut Random) -> Vec<u8> {
    let at = random.below(text.len());
    match random.below(9) {
        0 => text.truncate(at),
        1 => (0..=random.below(8)).for_each(|_| flip(&mut text, random)),
        2 => drop(text.drain(at..(at + random.below(40)).min(text.len()))),
        3 => drop(text.splice(at..at, words::token(random).bytes())),
        4 => drop(text.splice(0..0, [0xef, 0xbb, 0xbf])),
        5 => return utf16(&text, random),
        6 => text = key_twice(&text, random),
        7 => drop(text.splice(at..at, "[".repeat(random.one([10, 1000, 100_000])).bytes())),
        _ => text.extend_from_within(at..),
    }
    text
}

fn flip(text: &mut [u8], random: &mut Random) {
    let at = random.below(text.len());
    if let Some(byte) = text.get_mut(at) {
        *byte ^= 1 << random.below(8);
    }
}

/// In either order of the bytes, with or without its mark.
fn utf16(text: &[u8], random: &mut Random) -> Vec<u8> {
    let text = String::from_utf8_lossy(text);
    let mark = if random.is_one_in(2) { "\u{feff}" } else { "" };
    let units = mark.encode_utf16().chain(text.encode_utf16());
    if random.is_one_in(2) {
        units.flat_map(u16::to_le_bytes).collect()
    } else {
        units.flat_map(u16::to_be_bytes).collect()
    }
}

/// A line of the file stands there twice, so that a key does.
fn key_twice(text: &[u8], random: &mut Random) -> Vec<u8> {
    let lines: Vec<&[u8]> = text.split_inclusive(|byte| *byte == b'\n').collect();
    let again = random.below(lines.len());
    lines.iter().enumerate().flat_map(|(i, line)| line.repeat(1 + usize::from(i == again))).collect()
}
