//! Methods of `str`.

mod template;

use std::rc::Rc;

use super::callable::Arguments;
use super::conversion::sequence_of;
use super::error::{ExpressionError, Outcome, fail};
use super::interpreter::Interpreter;
use super::subscript::{length, window};
use super::value::Value;

pub(super) const NAMES: &[&str] = &[
    "capitalize",
    "center",
    "count",
    "endswith",
    "find",
    "format",
    "index",
    "isalnum",
    "isalpha",
    "isdecimal",
    "isdigit",
    "isidentifier",
    "islower",
    "isnumeric",
    "isspace",
    "isupper",
    "join",
    "ljust",
    "lower",
    "lstrip",
    "partition",
    "removeprefix",
    "removesuffix",
    "replace",
    "rfind",
    "rindex",
    "rjust",
    "rpartition",
    "rsplit",
    "rstrip",
    "split",
    "splitlines",
    "startswith",
    "strip",
    "swapcase",
    "title",
    "upper",
    "zfill",
];

pub(super) fn call(
    interpreter: &mut Interpreter<'_>,
    text: &Rc<str>,
    name: &str,
    arguments: Arguments,
) -> Outcome<Value> {
    // Every method scans the text a few times and returns about the same length, unless charged below.
    interpreter.budget.scan(text.len() * 4)?;
    interpreter.budget.allocate(text.len() as u128 * 3)?;
    let boolean = |arguments: Arguments, answer: bool| -> Outcome<Value> {
        let [] = arguments.exactly(name)?;
        Ok(Value::Bool(answer))
    };
    let plain = |arguments: Arguments, make: &dyn Fn(&str) -> String| -> Outcome<Value> {
        let [] = arguments.exactly(name)?;
        Ok(Value::text(make(text)))
    };
    let all = |test: &dyn Fn(char) -> bool| !text.is_empty() && text.chars().all(test);
    match name {
        "format" => template::format(interpreter, text, &arguments).map(Value::text),
        "join" => join(interpreter, text, arguments),
        "split" | "rsplit" => split(interpreter, text, name, arguments),
        "splitlines" => split_lines(interpreter, text, arguments),
        "partition" | "rpartition" => partition(text, name, arguments),
        "strip" | "lstrip" | "rstrip" => strip(text, name, arguments),
        "replace" => replace(interpreter, text, arguments),
        "startswith" | "endswith" => starts_or_ends(text, name, arguments),
        "removeprefix" | "removesuffix" => {
            let [part] = arguments.exactly(name)?;
            let part = text_of(&part, name)?;
            let rest = if name == "removeprefix" {
                text.strip_prefix(&*part)
            } else {
                text.strip_suffix(&*part)
            };
            Ok(Value::text(rest.unwrap_or(text)))
        }
        "find" | "rfind" | "index" | "rindex" | "count" => find(text, name, arguments),
        "center" | "ljust" | "rjust" => justify(interpreter, text, name, arguments),
        "zfill" => zfill(interpreter, text, arguments),
        "lower" => plain(arguments, &str::to_lowercase),
        "upper" => plain(arguments, &str::to_uppercase),
        "title" => plain(arguments, &title),
        "capitalize" => plain(arguments, &|text| {
            let mut letters = text.chars();
            letters.next().map_or_else(String::new, |first| {
                title_letter(first) + &letters.as_str().to_lowercase()
            })
        }),
        "swapcase" => plain(arguments, &|text| {
            text.chars()
                .map(|letter| {
                    if letter.is_uppercase() {
                        letter.to_lowercase().to_string()
                    } else {
                        letter.to_uppercase().to_string()
                    }
                })
                .collect()
        }),
        "isalpha" => boolean(arguments, all(&char::is_alphabetic)),
        "isalnum" => boolean(arguments, all(&|letter| letter.is_alphanumeric())),
        "isdigit" | "isdecimal" => boolean(
            arguments,
            all(&|letter| letter.is_ascii_digit() || (!letter.is_ascii() && is_decimal(letter))),
        ),
        "isnumeric" => boolean(arguments, all(&char::is_numeric)),
        "isspace" => boolean(arguments, all(&is_space)),
        "islower" => boolean(
            arguments,
            text.chars().any(char::is_lowercase) && !text.chars().any(char::is_uppercase),
        ),
        "isupper" => boolean(
            arguments,
            text.chars().any(char::is_uppercase) && !text.chars().any(char::is_lowercase),
        ),
        "isidentifier" => {
            let starts_well = text.starts_with(|first: char| first == '_' || first.is_alphabetic());
            boolean(
                arguments,
                starts_well && text.chars().all(|letter| letter == '_' || letter.is_alphanumeric()),
            )
        }
        _ => fail(format!("a `str` has no attribute `{name}`")),
    }
}

/// Digits of other scripts are in runs of ten; Rust has no table of them, and other numeric characters,
/// such as fractions, are far from letters. Robot files have neither.
fn is_decimal(letter: char) -> bool {
    letter.is_numeric()
}

/// Python treats the separators of ASCII as blanks, Unicode and Rust do not.
fn is_space(letter: char) -> bool {
    letter.is_whitespace() || ('\u{1c}'..='\u{1f}').contains(&letter)
}

fn text_of(value: &Value, method: &str) -> Outcome<Rc<str>> {
    match value {
        Value::Str(text) => Ok(text.clone()),
        other => {
            Err(ExpressionError::new(format!("`{method}` needs text, not `{}`", other.type_name()))
                .with_help("turn it into text: str(...)"))
        }
    }
}

fn join(
    interpreter: &mut Interpreter<'_>,
    separator: &str,
    arguments: Arguments,
) -> Outcome<Value> {
    let [values] = arguments.exactly("join")?;
    let iterator = interpreter.iterate(&values)?;
    let mut result = String::new();
    let mut is_first = true;
    while let Some(value) = interpreter.next(&iterator)? {
        let Value::Str(text) = &value else {
            return Err(ExpressionError::new(format!(
                "`join` joins text, and one element is a `{}`",
                value.type_name()
            ))
            .with_help("turn the elements into text first: map(str, ...)"));
        };
        interpreter.budget.allocate(2 * (separator.len() + text.len()) as u128)?;
        if !is_first {
            result.push_str(separator);
        }
        result.push_str(text);
        is_first = false;
    }
    Ok(Value::text(result))
}

fn split(
    interpreter: &mut Interpreter<'_>,
    text: &str,
    name: &str,
    arguments: Arguments,
) -> Outcome<Value> {
    let [separator, most] = arguments.bind(name, ["sep", "maxsplit"], 0)?;
    let most = most.map_or(Ok(-1), |most| most.integer())?;
    let most = usize::try_from(most).unwrap_or(usize::MAX - 1);
    match separator {
        None | Some(Value::None) => split_at_blanks(interpreter, text, most, name == "rsplit"),
        Some(separator) => {
            let separator = text_of(&separator, name)?;
            if separator.is_empty() {
                return fail("the separator is empty");
            }
            if name == "split" {
                return sequence_of(
                    interpreter,
                    text.splitn(most + 1, &*separator).map(str::to_owned),
                );
            }
            let Value::List(reversed) =
                sequence_of(interpreter, text.rsplitn(most + 1, &*separator).map(str::to_owned))?
            else {
                return fail("no list");
            };
            Value::list(reversed.iter().rev().cloned().collect())
        }
    }
}

fn split_at_blanks(
    interpreter: &mut Interpreter<'_>,
    text: &str,
    most: usize,
    from_right: bool,
) -> Outcome<Value> {
    let mut parts: Vec<String> = Vec::new();
    let mut rest = text;
    loop {
        rest = if from_right {
            rest.trim_end_matches(is_space)
        } else {
            rest.trim_start_matches(is_space)
        };
        if rest.is_empty() {
            break;
        }
        interpreter.budget.allocate(48)?;
        let cut = if parts.len() >= most {
            None
        } else if from_right {
            rest.char_indices()
                .rev()
                .find(|(_, letter)| is_space(*letter))
                .map(|(place, letter)| (place + letter.len_utf8(), place))
        } else {
            rest.find(is_space).map(|place| (place, place))
        };
        let Some((first_end, second_end)) = cut else {
            // The last part keeps blanks inside and at its own end, but not at the side where the split
            // starts.
            parts
                .push((if from_right { rest.trim_end_matches(is_space) } else { rest }).to_owned());
            break;
        };
        if from_right {
            parts.push(rest[first_end..].to_owned());
            rest = &rest[..second_end];
        } else {
            parts.push(rest[..first_end].to_owned());
            rest = &rest[first_end..];
        }
    }
    if from_right {
        parts.reverse();
    }
    sequence_of(interpreter, parts.into_iter())
}

fn split_lines(
    interpreter: &mut Interpreter<'_>,
    text: &str,
    arguments: Arguments,
) -> Outcome<Value> {
    let [keep_ends] = arguments.bind("splitlines", ["keepends"], 0)?;
    let keep_ends = keep_ends.is_some_and(|keep| keep.is_true());
    let mut lines = Vec::new();
    let mut rest = text;
    let is_end = |letter: char| {
        matches!(
            letter,
            '\n' | '\r' | '\u{b}' | '\u{c}' | '\u{1c}'
                ..='\u{1e}' | '\u{85}' | '\u{2028}' | '\u{2029}'
        )
    };
    while !rest.is_empty() {
        interpreter.budget.allocate(48)?;
        let end = rest.find(is_end).unwrap_or(rest.len());
        let break_length = if rest[end..].starts_with("\r\n") {
            2
        } else {
            rest[end..].chars().next().map_or(0, char::len_utf8)
        };
        lines.push(rest[..if keep_ends { end + break_length } else { end }].to_owned());
        rest = &rest[end + break_length..];
    }
    sequence_of(interpreter, lines.into_iter())
}

fn partition(text: &str, name: &str, arguments: Arguments) -> Outcome<Value> {
    let [separator] = arguments.exactly(name)?;
    let separator = text_of(&separator, name)?;
    if separator.is_empty() {
        return fail("the separator is empty");
    }
    let found = if name == "partition" {
        text.split_once(&*separator)
    } else {
        text.rsplit_once(&*separator)
    };
    let parts = match (found, name) {
        (Some((before, after)), _) => [before, &separator, after],
        (None, "partition") => [text, "", ""],
        (None, _) => ["", "", text],
    };
    Value::tuple(parts.into_iter().map(Value::text).collect())
}

fn strip(text: &str, name: &str, arguments: Arguments) -> Outcome<Value> {
    let [letters] = arguments.bind(name, ["chars"], 0)?;
    let letters = match &letters {
        None | Some(Value::None) => None,
        Some(letters) => Some(text_of(letters, name)?),
    };
    // Limits the time of searching all letters for each letter.
    if letters.as_ref().is_some_and(|letters| letters.len() > 1000) {
        return fail(format!("`{name}` takes at most 1000 bytes of letters"));
    }
    let is_stripped = |letter: char| {
        letters.as_ref().map_or_else(|| is_space(letter), |letters| letters.contains(letter))
    };
    Ok(Value::text(match name {
        "strip" => text.trim_matches(is_stripped),
        "lstrip" => text.trim_start_matches(is_stripped),
        _ => text.trim_end_matches(is_stripped),
    }))
}

fn replace(interpreter: &mut Interpreter<'_>, text: &str, arguments: Arguments) -> Outcome<Value> {
    let values = arguments.all("replace")?;
    let (old, new, most) = match values.as_slice() {
        [old, new] => (old, new, -1),
        [old, new, most] => (old, new, most.integer()?),
        _ => return fail(format!("`replace` takes 2 to 3 arguments, not {}", values.len())),
    };
    let (old, new) = (text_of(old, "replace")?, text_of(new, "replace")?);
    let most = usize::try_from(most).unwrap_or(usize::MAX);
    // Python does not replace in an empty text if a count is given.
    let occurrences = text.matches(&*old).count().min(most);
    interpreter.budget.allocate(occurrences as u128 * new.len() as u128 + text.len() as u128)?;
    Ok(Value::text(text.replacen(&*old, &new, most)))
}

fn starts_or_ends(text: &str, name: &str, arguments: Arguments) -> Outcome<Value> {
    let [parts, start, stop] = arguments.bind(name, ["prefix", "start", "end"], 1)?;
    let parts = match parts.unwrap_or(Value::None) {
        Value::Tuple(parts) => parts.items().to_vec(),
        part => vec![part],
    };
    let Some((_, text)) = window(text, &start, &stop)? else {
        return Ok(Value::Bool(false));
    };
    for part in parts {
        let part = text_of(&part, name)?;
        if if name == "startswith" { text.starts_with(&*part) } else { text.ends_with(&*part) } {
            return Ok(Value::Bool(true));
        }
    }
    Ok(Value::Bool(false))
}

fn find(text: &str, name: &str, arguments: Arguments) -> Outcome<Value> {
    let [part, start, stop] = arguments.bind(name, ["sub", "start", "end"], 1)?;
    let part = text_of(&part.unwrap_or(Value::None), name)?;
    let found = window(text, &start, &stop)?;
    if name == "count" {
        return Ok(Value::Int(found.map_or(0, |(_, text)| text.matches(&*part).count()) as i128));
    }
    let place = found.and_then(|(offset, text)| {
        let byte = if name.starts_with('r') { text.rfind(&*part) } else { text.find(&*part) };
        byte.map(|byte| offset + length(&text[..byte]))
    });
    match place {
        Some(place) => Ok(Value::Int(place as i128)),
        None if name.ends_with("find") => Ok(Value::Int(-1)),
        None => fail(format!("the text does not contain '{}'", part.escape_debug())),
    }
}

fn justify(
    interpreter: &mut Interpreter<'_>,
    text: &str,
    name: &str,
    arguments: Arguments,
) -> Outcome<Value> {
    let [width, fill] = arguments.bind(name, ["width", "fillchar"], 1)?;
    let width =
        usize::try_from(width.unwrap_or(Value::None).integer()?.max(0)).unwrap_or(usize::MAX);
    let fill = match fill {
        None => ' ',
        Some(fill) => {
            let fill = text_of(&fill, name)?;
            let mut letters = fill.chars();
            match (letters.next(), letters.next()) {
                (Some(letter), None) => letter,
                _ => return fail("the fill is one character"),
            }
        }
    };
    let missing = width.saturating_sub(length(text));
    interpreter.budget.allocate(missing as u128 * fill.len_utf8() as u128)?;
    let left = match name {
        "ljust" => 0,
        "rjust" => missing,
        // Python adds the odd blank on the left if the width is odd.
        _ => missing / 2 + (missing & width & 1),
    };
    let fill = |count: usize| fill.to_string().repeat(count);
    Ok(Value::text(fill(left) + text + &fill(missing - left)))
}

fn zfill(interpreter: &mut Interpreter<'_>, text: &str, arguments: Arguments) -> Outcome<Value> {
    let [width] = arguments.exactly("zfill")?;
    let width = usize::try_from(width.integer()?.max(0)).unwrap_or(usize::MAX);
    let missing = width.saturating_sub(length(text));
    interpreter.budget.allocate(missing as u128)?;
    let (sign, digits) = text.split_at(usize::from(text.starts_with(['+', '-'])));
    Ok(Value::text(format!("{sign}{}{digits}", "0".repeat(missing))))
}

fn title_letter(letter: char) -> String {
    let mut upper = letter.to_uppercase();
    let first: String = upper.next().into_iter().collect();
    // A letter that becomes several, such as the German sharp s, is upper case only in front.
    first + &upper.collect::<String>().to_lowercase()
}

fn title(text: &str) -> String {
    let mut result = String::with_capacity(text.len());
    let mut in_word = false;
    for letter in text.chars() {
        if in_word {
            result.extend(letter.to_lowercase());
        } else {
            result.push_str(&title_letter(letter));
        }
        in_word = letter.is_uppercase() || letter.is_lowercase();
    }
    result
}
