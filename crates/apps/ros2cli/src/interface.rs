//! `interface`: types and their definitions. Needs no network.

use std::collections::BTreeSet;

use periplus_diagnostics::closest;
use periplus_msgs::{DynamicMessage, YamlStyle};
use periplus_rosidl::{Definition, Interface, InterfaceKind, Registry, TypeName};
use serde_json::json;

use crate::{Failure, Outcome, Session};

/// Comments to print.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Comments {
    /// Comments of the type itself.
    #[default]
    Own,
    /// Comments of nested types, too.
    All,
    /// None.
    None,
}

/// Kinds in the order of the output, with their headings.
const KINDS: [(InterfaceKind, &str); 3] = [
    (InterfaceKind::Message, "Messages"),
    (InterfaceKind::Service, "Services"),
    (InterfaceKind::Action, "Actions"),
];

/// Lists all types of some kinds; of all kinds if none is given.
///
/// # Errors
/// When the output cannot be written.
pub fn list(session: &mut Session<'_>, kinds: &[InterfaceKind]) -> Outcome {
    let registry = session.types.registry().registry();
    let of = |kind: InterfaceKind| -> Vec<String> {
        let all = registry.interfaces().map(|one| &one.name);
        all.filter(|name| name.kind == kind).map(TypeName::to_string).collect()
    };
    let shown = KINDS.iter().filter(|(kind, _)| kinds.is_empty() || kinds.contains(kind));
    if session.json {
        let lists = shown.map(|(kind, title)| (title.to_lowercase(), of(*kind).into()));
        return session.put(&serde_json::Value::Object(lists.collect()));
    }
    for (kind, title) in shown {
        writeln!(session.out, "{title}:")?;
        for name in of(*kind) {
            writeln!(session.out, "    {name}")?;
        }
    }
    session.out.flush()?;
    Ok(())
}

/// Lists the packages that have types of some kinds; of any kind if none is given.
///
/// # Errors
/// When the output cannot be written.
pub fn packages(session: &mut Session<'_>, kinds: &[InterfaceKind]) -> Outcome {
    let all = session.types.registry().registry().interfaces().map(|one| &one.name);
    let all = all.filter(|name| kinds.is_empty() || kinds.contains(&name.kind));
    let names: BTreeSet<&str> = all.map(|name| name.package.as_str()).collect();
    if session.json {
        return session.put(&json!({ "packages": names }));
    }
    for name in names {
        writeln!(session.out, "{name}")?;
    }
    session.out.flush()?;
    Ok(())
}

/// Lists the types of a package.
///
/// # Errors
/// When there is no such package, or the output cannot be written.
pub fn package(session: &mut Session<'_>, package: &str) -> Outcome {
    let registry = session.types.registry().registry();
    let all = || registry.interfaces().map(|one| &one.name);
    let names = all().filter(|name| name.package == package).map(TypeName::to_string);
    let names: Vec<String> = names.collect();
    if names.is_empty() {
        let near = closest(package, all().map(|name| name.package.as_str()));
        let near = near.map_or(String::new(), |near| format!("; did you mean `{near}`?"));
        return Err(Failure::failed(format!("Unknown package '{package}'{near}")));
    }
    if session.json {
        return session.put(&json!({ "package": package, "types": names }));
    }
    for name in names {
        writeln!(session.out, "{name}")?;
    }
    session.out.flush()?;
    Ok(())
}

/// Looks up a type by name, of any kind if the name does not specify it.
fn look_up<'t>(session: &Session<'t>, name: &str) -> Outcome<&'t Interface> {
    let registry = session.types.registry().registry();
    let parts: Vec<&str> = name.split('/').collect();
    let written = match parts[..] {
        [package, name] => KINDS.iter().find_map(|(kind, _)| {
            let full = TypeName::read(&format!("{package}/{}/{name}", kind.word()))?;
            registry.interface(&full)
        }),
        _ => TypeName::read(name).and_then(|name| registry.interface(&name)),
    };
    written.ok_or_else(|| {
        let known: Vec<String> = registry.interfaces().map(|one| one.name.to_string()).collect();
        let near = closest(name, known.iter().map(String::as_str));
        let near = near.map_or(String::new(), |near| format!("; did you mean `{near}`?"));
        Failure::failed(format!(
            "Unknown type '{name}'{near} A type is written like `sensor_msgs/msg/LaserScan`; \
             `--interfaces DIR` adds packages"
        ))
    })
}

/// Prints the definition of a type, with nested types indented below the fields.
///
/// # Errors
/// When there is no such type, or the output cannot be written.
pub fn show(session: &mut Session<'_>, name: &str, comments: Comments) -> Outcome {
    let interface = look_up(session, name)?;
    let registry = session.types.registry().registry();
    let parts = interface.parts.iter().map(|part| {
        let mut text = String::new();
        write_part(registry, part, comments, 0, &mut text);
        text
    });
    let text = parts.collect::<Vec<_>>().join("---\n");
    if session.json {
        let name = interface.name.to_string();
        let hash = session.types.registry().hash(&name);
        return session.put(&json!({ "name": name, "hash": hash, "text": text }));
    }
    write!(session.out, "{text}")?;
    session.out.flush()?;
    Ok(())
}

fn write_part(
    registry: &Registry,
    part: &Definition,
    comments: Comments,
    depth: usize,
    out: &mut String,
) {
    let is_commented = match comments {
        Comments::Own => depth == 0,
        Comments::All => true,
        Comments::None => false,
    };
    for line in part.text.lines() {
        let line = line.trim_end();
        let (code, _) = line.split_once('#').unwrap_or((line, ""));
        // A `#` in a string constant does not start a comment.
        let code = if code.contains(['"', '\'']) { line } else { code.trim_end() };
        let line = if is_commented { line } else { code };
        if line.is_empty() && !is_commented {
            continue;
        }
        out.push_str(&"\t".repeat(depth));
        out.push_str(line);
        out.push('\n');
        if let Some(nested) = nested(part, code).and_then(|name| registry.get(name)) {
            write_part(registry, nested, comments, depth + 1, out);
        }
    }
}

/// Message type of the field in a line.
fn nested<'p>(part: &'p Definition, line: &str) -> Option<&'p TypeName> {
    let mut words = line.split_whitespace();
    let (_, name) = (words.next()?, words.next()?);
    part.nested().find(|(field, _)| field.name == name).map(|(_, nested)| nested)
}

/// Prints a message to edit and use with `topic pub`, `service call` or `action send_goal`.
///
/// # Errors
/// When there is no such type, or the output cannot be written.
pub fn proto(session: &mut Session<'_>, name: &str, quotes: bool) -> Outcome {
    let interface = look_up(session, name)?;
    let first = interface.parts.first().map(|part| part.name.to_string()).unwrap_or_default();
    let layout = session.types.registry().layout(&first);
    let layout = layout.ok_or_else(|| Failure::failed(format!("Unknown type '{first}'")))?;
    let blank = DynamicMessage::blank(layout);
    if session.json {
        return session.put(&blank.to_json());
    }
    let style = YamlStyle { longest: None, ..YamlStyle::default() };
    let (text, quote) = (blank.to_yaml(&style), if quotes { "\"" } else { "" });
    writeln!(session.out, "{quote}{text}{quote}")?;
    session.out.flush()?;
    Ok(())
}
