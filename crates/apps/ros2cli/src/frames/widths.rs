//! Text widths in Helvetica, a standard font of PDF.

/// Widths of the characters from `' '` to `'~'`, in thousandths of the size (the metrics that Adobe
/// published with the standard fonts).
const HELVETICA: [u16; 95] = [
    278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278, 278, // to '/'
    556, 556, 556, 556, 556, 556, 556, 556, 556, 556, 278, 278, 584, 584, 584, 556, // to '?'
    1015, 667, 667, 722, 722, 667, 611, 778, 722, 278, 500, 667, 556, 833, 722, 778, // to 'O'
    667, 778, 722, 667, 611, 722, 667, 944, 667, 667, 611, 278, 278, 278, 469, 556, // to '_'
    333, 556, 556, 500, 556, 556, 278, 556, 556, 222, 222, 500, 222, 833, 556, 556, // to 'o'
    556, 556, 333, 500, 278, 556, 500, 722, 500, 500, 500, 334, 260, 334, 584, // to '~'
];

/// The widest character, for those that are not listed.
const MAX_CHAR_WIDTH: u16 = 1015;

/// Maximum factor by which bold characters are wider.
const BOLD_FACTOR: f64 = 1.1;

/// Width of a line \[pt\]; an upper bound for bold text.
pub(crate) fn width(text: &str, size: f64, is_bold: bool) -> f64 {
    let of = |letter: char| {
        let place = (letter as usize).checked_sub(' ' as usize);
        place.and_then(|place| HELVETICA.get(place)).copied().unwrap_or(MAX_CHAR_WIDTH)
    };
    let sum: f64 = text.chars().map(|letter| f64::from(of(letter))).sum();
    sum * 1e-3 * size * if is_bold { BOLD_FACTOR } else { 1.0 }
}

#[test]
fn words_have_widths() {
    // 722 + 556 + 556 + 222 + 222: "Hello" is known to be 22.78 pt wide at 10 pt.
    assert!((width("Hello", 10.0, false) - 22.78).abs() < 1e-9);
}
