//! The `params` of a macro.

use std::ops::Range;

use smol_str::SmolStr;

/// One parameter of a macro.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Parameter {
    /// Name of the parameter; a block starts with `*`, the content of a block with `**`.
    pub(crate) name: SmolStr,
    /// `^`: uses the caller's property of the same name if the call omits the parameter.
    pub(crate) forward: bool,
    /// Value if the call omits the parameter and nothing is forwarded.
    pub(crate) default: Option<SmolStr>,
    /// Byte offset in `params` at which the default starts.
    pub(crate) default_start: usize,
}

impl Parameter {
    pub(crate) fn is_block(&self) -> bool {
        self.name.starts_with('*')
    }

    /// Byte range of the default in `params`.
    pub(crate) fn default_range(&self) -> Range<usize> {
        let length = self.default.as_ref().map_or(0, SmolStr::len);
        self.default_start..self.default_start + length
    }

    pub(crate) fn is_required(&self) -> bool {
        !self.forward && self.default.is_none()
    }
}

/// Reads `a b:=1 c:='x y' d:=^ e:=^|${pi/2} *block **content`.
pub(crate) fn parse(text: &str) -> Vec<Parameter> {
    let mut parameters = Vec::new();
    let mut rest = text.trim_start();
    while !rest.is_empty() {
        let name_end = rest.find(|c: char| c.is_whitespace() || c == ':' || c == '=');
        let name_end = name_end.unwrap_or(rest.len());
        let after_name = rest[name_end..].trim_start();
        let assigned = after_name.strip_prefix(":=").or_else(|| after_name.strip_prefix('='));
        match assigned {
            Some(value) if name_end > 0 => {
                let name = SmolStr::new(&rest[..name_end]);
                let value = value.trim_start();
                let (forward, value) = match value.strip_prefix('^') {
                    Some(value) => (true, value.strip_prefix('|').unwrap_or(value)),
                    None => (false, value),
                };
                let length = default_length(value);
                let default = &value[..length];
                // `a:=` is an empty default, `a:=^` none.
                let default = (!default.is_empty() || !forward).then(|| SmolStr::new(default));
                let default_start = text.len() - value.len();
                parameters.push(Parameter { name, forward, default, default_start });
                rest = value[length..].trim_start();
            }
            _ => {
                let end = rest.find(char::is_whitespace).unwrap_or(rest.len());
                let name = SmolStr::new(&rest[..end]);
                parameters.push(Parameter {
                    name,
                    forward: false,
                    default: None,
                    default_start: 0,
                });
                rest = rest[end..].trim_start();
            }
        }
    }
    parameters
}

/// Length of a default in bytes: up to white space that is not inside quotes, `${...}` or `$(...)`.
fn default_length(text: &str) -> usize {
    let mut at = 0;
    while let Some(character) = text[at..].chars().next() {
        let skip_to = match character {
            _ if character.is_whitespace() => return at,
            '\'' | '"' => text[at + 1..].find(character).map(|end| at + 1 + end + 1),
            '$' if text[at..].starts_with("${") => text[at..].find('}').map(|end| at + end + 1),
            '$' if text[at..].starts_with("$(") => text[at..].find(')').map(|end| at + end + 1),
            _ => None,
        };
        at = skip_to.unwrap_or(at + character.len_utf8());
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(text: &str, expected: &[&str]) {
        let shown: Vec<String> = parse(text)
            .iter()
            .map(|p| {
                let forward = if p.forward { "^" } else { "" };
                match &p.default {
                    Some(default) => format!("{}={forward}[{default}]", p.name),
                    None => format!("{}{forward}", p.name),
                }
            })
            .collect();
        assert_eq!(shown, expected);
    }

    #[test]
    fn every_form() {
        check(
            " a b:=1 c='x y'  d:=^ e:=^|${pi / 2}\n*block **content f := $(arg g) h:=",
            &[
                "a",
                "b=[1]",
                "c=['x y']",
                "d^",
                "e=^[${pi / 2}]",
                "*block",
                "**content",
                "f=[$(arg g)]",
                "h=[]",
            ],
        );
    }

    #[test]
    fn glued_parts_are_one_default() {
        check(
            "prefix:=${a}_${b} xyz:='1 2 3' q:=a'b c'd",
            &["prefix=[${a}_${b}]", "xyz=['1 2 3']", "q=[a'b c'd]"],
        );
    }
}
