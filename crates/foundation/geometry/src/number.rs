//! Numbers in robot files.

/// Returns the shortest text that reads back as the same number, with an exponent if it is very large or
/// small.
#[must_use]
pub fn format_number(value: f64) -> String {
    let magnitude = value.abs();
    if value == 0.0 {
        return String::from(if value.is_sign_negative() { "-0" } else { "0" });
    }
    if value.is_infinite() {
        return String::from(if value > 0.0 { "inf" } else { "-inf" });
    }
    if value.is_nan() {
        return String::from("nan");
    }
    if (1e-5..1e16).contains(&magnitude) { format!("{value}") } else { format!("{value:e}") }
}

/// Parses one decimal number: `1`, `-.5`, `+2.`, `1e-3`, `inf`, `nan` (any case). White space around it is
/// allowed.
#[must_use]
pub fn parse_number(text: &str) -> Option<f64> {
    // `str::parse::<f64>` accepts all of these, and also "infinity", which `strtod` accepts too.
    text.trim().parse().ok()
}

/// Parses numbers separated by white space.
///
/// # Errors
/// Byte range of the first word that is not a number.
pub fn parse_numbers(text: &str) -> Result<Vec<f64>, std::ops::Range<usize>> {
    let mut numbers = Vec::new();
    for word in text.split_ascii_whitespace() {
        let start = word.as_ptr() as usize - text.as_ptr() as usize;
        numbers.push(parse_number(word).ok_or(start..start + word.len())?);
    }
    Ok(numbers)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn numbers_print_short() {
        let printed = [0.1, 1.0, -2.5, 1e-9, 1e20, 0.0].map(format_number);
        assert_eq!(printed, ["0.1", "1", "-2.5", "1e-9", "1e20", "0"]);
    }

    #[test]
    fn numbers_are_read_as_people_write_them() {
        assert_eq!(parse_numbers(" 1 -.5\n+2. 1e-3"), Ok(vec![1.0, -0.5, 2.0, 1e-3]));
        assert_eq!(parse_numbers("1 ${-pi/2}"), Err(2..10));
        assert_eq!(parse_numbers(""), Ok(vec![]));
    }

    proptest! {
        #[test]
        fn every_number_reads_back(value: f64) {
            let read = parse_number(&format_number(value)).unwrap();
            prop_assert!(read.to_bits() == value.to_bits() || value.is_nan() && read.is_nan());
        }
    }
}
