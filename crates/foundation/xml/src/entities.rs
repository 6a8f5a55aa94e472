//! `&lt;`, `&#65;` and the entities a file declares in its DOCTYPE.

use std::collections::BTreeMap;

/// Maximum nesting depth of declared entities.
const MAX_DEPTH: usize = 16;

/// Maximum expansion of all declared entities of a file together [bytes]; stops entity bombs.
const MAX_BYTES: usize = 1 << 20;

/// Entities of one file.
#[derive(Default)]
pub(crate) struct Entities {
    declared: BTreeMap<String, String>,
    /// Names declared with SYSTEM or PUBLIC: external files, which are never read.
    external: Vec<String>,
    spent: usize,
}

/// Reason that a reference was not resolved.
pub(crate) enum Unresolved {
    /// Not declared.
    Unknown,
    /// External file.
    External,
    /// Too deep or too long.
    Bomb,
    /// Contains markup.
    Markup,
}

impl Entities {
    /// Reads the internal subset of a DOCTYPE: the part in brackets.
    pub(crate) fn declare(&mut self, doctype: &str) {
        for declaration in doctype.split("<!ENTITY").skip(1) {
            let mut words = declaration.trim_start().splitn(2, char::is_whitespace);
            let (Some(name), Some(rest)) = (words.next(), words.next()) else { continue };
            let rest = rest.trim_start();
            let quote = rest.chars().next();
            match quote {
                Some(quote @ ('"' | '\'')) => {
                    let value = rest[1..].split(quote).next().unwrap_or_default();
                    // The first declaration binds (XML 1.0, section 4.2).
                    self.declared.entry(name.to_owned()).or_insert_with(|| value.to_owned());
                }
                _ => self.external.push(name.to_owned()),
            }
        }
    }

    /// Replacement text of `&name;`.
    pub(crate) fn resolve(&mut self, name: &str) -> Result<String, Unresolved> {
        let mut text = String::new();
        self.resolve_into(name, &mut text, 0)?;
        Ok(text)
    }

    fn resolve_into(
        &mut self,
        name: &str,
        out: &mut String,
        depth: usize,
    ) -> Result<(), Unresolved> {
        if let Some(character) = character(name) {
            out.push(character);
            return Ok(());
        }
        if self.external.iter().any(|external| external == name) {
            return Err(Unresolved::External);
        }
        let value = self.declared.get(name).ok_or(Unresolved::Unknown)?.clone();
        self.spent += value.len() + 1;
        if depth >= MAX_DEPTH || self.spent > MAX_BYTES {
            return Err(Unresolved::Bomb);
        }
        if value.contains('<') {
            return Err(Unresolved::Markup);
        }
        let mut rest = value.as_str();
        while let Some(start) = rest.find('&') {
            out.push_str(&rest[..start]);
            let Some(length) = rest[start..].find(';') else { break };
            self.resolve_into(&rest[start + 1..start + length], out, depth + 1)?;
            rest = &rest[start + length + 1..];
        }
        out.push_str(rest);
        Ok(())
    }
}

/// The five predefined entities and character references.
fn character(name: &str) -> Option<char> {
    match name {
        "lt" => Some('<'),
        "gt" => Some('>'),
        "amp" => Some('&'),
        "quot" => Some('"'),
        "apos" => Some('\''),
        _ => {
            let number = name.strip_prefix('#')?;
            let code = match number.strip_prefix(['x', 'X']) {
                Some(hex) => u32::from_str_radix(hex, 16).ok()?,
                None => number.parse().ok()?,
            };
            char::from_u32(code).filter(|&character| character != '\0')
        }
    }
}
