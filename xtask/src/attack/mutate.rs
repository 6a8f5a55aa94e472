//! Changes that make a sound file hostile.

use super::random::Random;

/// Numbers that readers, grids and simulations must survive.
const NUMBERS: [&str; 22] = [
    "NaN",
    "nan",
    ".nan",
    "inf",
    "-inf",
    ".inf",
    "1e308",
    "-1e308",
    "1e-320",
    "1e999",
    "0",
    "-0.0",
    "-1",
    "2147483647",
    "-2147483649",
    "4294967296",
    "9223372036854775808",
    "99999999999999999999999",
    "0x7fffffff",
    "1e7",
    "1_000_000",
    "",
];

/// Longest file that a change makes \[bytes\].
const LONGEST: usize = 4 << 20;

/// A mutated copy.
pub(super) fn mutated(seed: &[u8], is_text: bool, random: &mut Random) -> Vec<u8> {
    let mut bytes = seed.to_vec();
    for _ in 0..=random.below(3) {
        bytes = if is_text && random.below(4) > 0 {
            text(&bytes, random)
        } else {
            binary(&bytes, random)
        };
    }
    bytes.truncate(LONGEST);
    bytes
}

/// Changes that any bytes can have.
fn binary(bytes: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    let at = random.below(bytes.len());
    let end = (at + 1 + random.below(64)).min(bytes.len());
    match random.below(9) {
        0 => bytes.truncate(at),
        1 => {
            for _ in 0..=random.below(16) {
                let at = random.below(bytes.len());
                if let Some(byte) = bytes.get_mut(at) {
                    *byte ^= 1 << random.below(8);
                }
            }
        }
        2 => drop(bytes.drain(at.min(end)..end)),
        3 => {
            let part = bytes.get(at..end).unwrap_or_default().to_vec();
            let most = (1 << 20) / part.len().max(1);
            let part = part.repeat(1 + random.below(most.min(20_000)));
            bytes.splice(at..at, part);
        }
        // Lengths and counts of binary formats: four or eight bytes with large numbers.
        4 | 5 => {
            let value =
                *random.pick(&[u64::MAX, u64::MAX >> 1, 0xFFFF_FFFF, 0x7FFF_FFFF, 1 << 30, 0, 1]);
            let width = *random.pick(&[2, 4, 8]);
            for (offset, byte) in value.to_le_bytes().iter().take(width).enumerate() {
                if let Some(place) = bytes.get_mut(at + offset) {
                    *place = *byte;
                }
            }
        }
        6 => {
            for byte in bytes.get_mut(at..end).unwrap_or_default() {
                *byte = random.next() as u8;
            }
        }
        7 => {
            let part = bytes.get(at..end).unwrap_or_default().to_vec();
            let to = random.below(bytes.len());
            bytes.splice(to..to, part);
        }
        _ => bytes.fill(*random.pick(&[0, 0xFF, b' '])),
    }
    bytes
}

/// Changes to texts: numbers, lines, encodings.
fn text(bytes: &[u8], random: &mut Random) -> Vec<u8> {
    let words = String::from_utf8_lossy(bytes).into_owned();
    match random.below(10) {
        0..=4 => numbers(&words, random).into_bytes(),
        5 => lines(&words, random, 0),
        6 => {
            let times = *random.pick(&[2, 100, 5_000]);
            lines(&words, random, times)
        }
        7 => words.encode_utf16().flat_map(u16::to_le_bytes).collect(),
        8 => {
            let mut bytes = words.into_bytes();
            let part: &[u8] = random.pick::<&[u8]>(&[
                &b"\0"[..],
                b"\xEF\xBB\xBF",
                b"\xFF\xFE",
                b"\xC3\x28",
                b"\xF0\x9F\x92\xA9",
                b"\xED\xA0\x80",
                b"\xE2\x80\xAE",
                b"<",
                b"&",
                b"]]>",
                b"-->",
                b"${",
                b"$(",
                b"{{",
                b"\"",
                b"'",
                b"%s",
                b"\t",
                b"\r",
            ]);
            let at = random.below(bytes.len());
            bytes.splice(at..at, part.iter().copied());
            bytes
        }
        _ => swapped_words(&words, random).into_bytes(),
    }
}

/// Replaces some of the numbers.
fn numbers(text: &str, random: &mut Random) -> String {
    let is_part = |letter: char| letter.is_ascii_digit() || ".eE+-".contains(letter);
    let starts: Vec<usize> = text
        .char_indices()
        .filter(|(at, letter)| {
            letter.is_ascii_digit() && !text[..*at].chars().next_back().is_some_and(is_part)
        })
        .map(|(at, _)| at)
        .collect();
    if starts.is_empty() {
        return text.to_owned();
    }
    let mut chosen: Vec<usize> = (0..=random.below(4)).map(|_| *random.pick(&starts)).collect();
    chosen.sort_unstable();
    chosen.dedup();
    let mut result = text.to_owned();
    for start in chosen.into_iter().rev() {
        let length = text[start..].find(|letter| !is_part(letter)).unwrap_or(text.len() - start);
        result.replace_range(start..start + length, random.pick::<&str>(&NUMBERS));
    }
    result
}

/// Removes a line, or repeats it.
fn lines(text: &str, random: &mut Random, times: usize) -> Vec<u8> {
    let lines: Vec<&str> = text.lines().collect();
    let chosen = random.below(lines.len());
    let mut result = String::new();
    for (at, line) in lines.iter().enumerate() {
        for _ in 0..if at == chosen { times } else { 1 } {
            result.push_str(line);
            result.push('\n');
        }
    }
    result.into_bytes()
}

/// Puts one word in the place of another: elements, keys and types where others belong.
fn swapped_words(text: &str, random: &mut Random) -> String {
    let words: Vec<&str> = text
        .split(|letter: char| !letter.is_alphanumeric() && letter != '_')
        .filter(|word| word.len() > 2)
        .collect();
    if words.is_empty() {
        return text.to_owned();
    }
    let (one, other) = (*random.pick(&words), *random.pick(&words));
    if random.below(2) == 0 { text.replacen(one, other, 1) } else { text.replace(one, other) }
}
