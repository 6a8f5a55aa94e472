//! Documentation of tables.

use std::fmt::Write as _;

use crate::{Default, ParamType, ParamValue, Parameter, Table};

impl Table {
    /// YAML file of the defaults, each below its description. Parameters without a default are commented
    /// out.
    #[must_use]
    pub fn to_yaml(&self) -> String {
        let mut out = format!("# {}\n{}:\n", self.doc, yaml_key(self.name));
        for parameter in self.parameters {
            let _ = writeln!(out, "  # {}", remark(parameter));
            match parameter.default {
                Default::Value(default) => match ParamValue::read(parameter, default) {
                    Ok(value) if parameter.repeated && !is_list(parameter.kind) => {
                        let _ = writeln!(out, "  {}: [{value}]", parameter.name);
                    }
                    Ok(value) => {
                        let _ = writeln!(out, "  {}: {value}", parameter.name);
                    }
                    Err(reason) => {
                        let _ = writeln!(out, "  # {}: the default {reason}", parameter.name);
                    }
                },
                Default::Required | Default::None => {
                    let _ = writeln!(out, "  # {}:", parameter.name);
                }
            }
        }
        out
    }

    /// Markdown section with a table of the parameters.
    #[must_use]
    pub fn to_markdown(&self) -> String {
        let mut out = format!("### {}\n\n{}\n", self.name, self.doc);
        if self.parameters.is_empty() {
            return out;
        }
        out.push_str("\n| Parameter | Type | Unit | Default | Range | Meaning |\n|---|---|---|---|---|---|\n");
        for parameter in self.parameters {
            let names: Vec<String> = std::iter::once(&parameter.name)
                .chain(parameter.aliases)
                .map(|name| format!("`{name}`"))
                .collect();
            let default = match parameter.default {
                Default::Required => "required".to_owned(),
                Default::None => String::new(),
                Default::Value(default) => format!("`{default}`"),
            };
            let several = if parameter.repeated { ", repeatable" } else { "" };
            let _ = writeln!(
                out,
                "| {} | {}{several} | {} | {default} | {} | {} |",
                names.join(", "),
                parameter.kind,
                parameter.unit.unwrap_or_default(),
                parameter.range.map(|range| range.to_string()).unwrap_or_default(),
                parameter.doc.replace('|', "\\|"),
            );
        }
        out
    }
}

/// Description, unit, choices, range, and whether it is required, in one line.
fn remark(parameter: &Parameter) -> String {
    let mut remark = parameter.doc.to_owned();
    if let Some(unit) = parameter.unit {
        let _ = write!(remark, " [{unit}]");
    }
    if let ParamType::Choice(words) = parameter.kind {
        let _ = write!(remark, " One of {}.", words.join(", "));
    }
    if let Some(range) = parameter.range {
        let _ = write!(remark, " ({range})");
    }
    if parameter.default == Default::Required {
        remark.push_str(" (required)");
    }
    remark
}

fn is_list(kind: ParamType) -> bool {
    matches!(kind, ParamType::NumberList | ParamType::TextList)
}

fn yaml_key(name: &str) -> String {
    ParamValue::Text(name.to_owned()).to_string()
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use crate::{Table, choice, number, numbers, text};

    static LAMP: Table = Table {
        name: "lamp",
        doc: "A lamp that blinks.",
        parameters: &[
            number("period", "s", "From flash to flash.").or("2").above(0.0).also(&["interval"]),
            choice("colour", &["red", "green"], "Of the light.").or("red"),
            text("socket", "Where it is plugged in.").required(),
            number("reach", "m", "How far one sees it.").or("inf").repeated(),
            numbers("pose", "m", "Where it stands.").or("0 0 1"),
            text("label", "Its sticker.").or("on"),
        ],
    };

    #[test]
    fn the_table_has_no_slips() {
        assert_eq!(LAMP.faults(), [""; 0]);
    }

    #[test]
    fn slips_of_a_table_are_found() {
        static BROKEN: Table = Table {
            name: "broken",
            doc: "",
            parameters: &[
                number("a", "m", "").or("x").also(&["b"]),
                number("b", "m", "").or("-1").min(0.0),
            ],
        };
        assert_eq!(
            BROKEN.faults(),
            [
                "broken: the default `x` of `a` is not a number",
                "broken: `b` is declared twice",
                "broken: the default `-1` of `b` is out of range: -1 m must be at least 0",
            ]
        );
    }

    #[test]
    fn yaml_holds_every_default() {
        expect![[r##"
            # A lamp that blinks.
            lamp:
              # From flash to flash. [s] (above 0)
              period: 2.0
              # Of the light. One of red, green.
              colour: red
              # Where it is plugged in. (required)
              # socket:
              # How far one sees it. [m]
              reach: [.inf]
              # Where it stands. [m]
              pose: [0.0, 0.0, 1.0]
              # Its sticker.
              label: "on"
        "##]]
        .assert_eq(&LAMP.to_yaml());
    }

    #[test]
    fn markdown_holds_every_parameter() {
        expect![[r#"
            ### lamp

            A lamp that blinks.

            | Parameter | Type | Unit | Default | Range | Meaning |
            |---|---|---|---|---|---|
            | `period`, `interval` | number | s | `2` | above 0 | From flash to flash. |
            | `colour` | red \| green |  | `red` |  | Of the light. |
            | `socket` | text |  | required |  | Where it is plugged in. |
            | `reach` | number, repeatable | m | `inf` |  | How far one sees it. |
            | `pose` | numbers | m | `0 0 1` |  | Where it stands. |
            | `label` | text |  | `on` |  | Its sticker. |
        "#]]
        .assert_eq(&LAMP.to_markdown());
    }
}
