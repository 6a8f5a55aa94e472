//! Text formats of messages: YAML is in `msgs`, the other formats are here. Each is one pass over
//! the values; truncation happens before formatting.

mod csv;
mod json;
mod python;

use periplus_msgs::{DynamicMessage, Number, Part, Sink, Value, YamlStyle};

use crate::{Failure, Outcome};

pub use python::repr;
pub(crate) use python::{float as python_float, text as python_text};

/// Output format of messages.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Form {
    /// YAML.
    #[default]
    Yaml,
    /// All values of a message on one line, separated by commas.
    Csv,
    /// JSON object on one line.
    Json,
}

/// Format settings.
#[derive(Clone, Debug, Default)]
pub struct Show {
    /// Format.
    pub form: Form,
    /// Truncation.
    pub style: YamlStyle,
    /// Only this field, such as `pose.pose.position` or `ranges[0]`.
    pub field: Option<String>,
}

impl Show {
    /// Formats a message with the end of its last line, without a separator between messages.
    ///
    /// # Errors
    /// When it has no such field.
    pub fn text(&self, message: &DynamicMessage) -> Outcome<String> {
        match &self.field {
            None => Ok(self.whole(message)),
            Some(path) => {
                let part = message.part(path).map_err(|error| {
                    let name = message.layout().type_name();
                    Failure::failed(format!("{name} has no field `{path}`: {error}"))
                })?;
                Ok(self.part(&part))
            }
        }
    }

    fn whole(&self, message: &DynamicMessage) -> String {
        match self.form {
            Form::Yaml => message.to_yaml(&self.style),
            form => self.walked(form, |sink| message.write(sink)),
        }
    }

    fn part(&self, part: &Part<'_>) -> String {
        match (self.form, part.peek()) {
            // In Python syntax, not as YAML: the output of `--field` is for scripts. Arrays of
            // fixed length are NumPy arrays, which Python prints rounded and in columns; they stay
            // YAML.
            (Form::Yaml | Form::Csv, Value::Numbers(_) | Value::List(_)) if part.is_sequence() => {
                python::sequence(part) + "\n"
            }
            (Form::Yaml, Value::Number(number)) => python::number(*number) + "\n",
            (Form::Yaml, Value::Text(_)) | (Form::Csv, _) => {
                self.walked(Form::Csv, |sink| part.write(sink))
            }
            (Form::Yaml, _) => part.to_yaml(&self.style),
            (form, _) => self.walked(form, |sink| part.write(sink)),
        }
    }

    fn walked(&self, form: Form, write: impl FnOnce(&mut dyn Sink)) -> String {
        let mut text = match form {
            Form::Csv => {
                let mut sink = csv::Csv::new(&self.style);
                write(&mut sink);
                sink.finish()
            }
            _ => {
                let mut sink = json::Json::new(self.style.longest);
                write(&mut sink);
                sink.out
            }
        };
        text.push('\n');
        text
    }
}

/// Number of elements to print.
fn shown(length: usize, longest: Option<usize>) -> usize {
    longest.map_or(length, |longest| longest.min(length))
}

/// First characters of a string; the flag is true if it was truncated.
fn cut(text: &str, longest: Option<usize>) -> (&str, bool) {
    match longest.and_then(|longest| text.char_indices().nth(longest)) {
        Some((end, _)) => (&text[..end], true),
        None => (text, false),
    }
}

/// Integer value of a number, if it is one.
fn whole(number: Number) -> Option<i128> {
    Some(match number {
        Number::I8(number) => number.into(),
        Number::U8(number) => number.into(),
        Number::I16(number) => number.into(),
        Number::U16(number) => number.into(),
        Number::I32(number) => number.into(),
        Number::U32(number) => number.into(),
        Number::I64(number) => number.into(),
        Number::U64(number) => number.into(),
        Number::Bool(_) | Number::F32(_) | Number::F64(_) => return None,
    })
}

/// Integer value of an integer number.
pub(crate) fn whole_number(number: Number) -> i128 {
    whole(number).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;
    use crate::Types;

    fn message(type_name: &str, json: &serde_json::Value) -> DynamicMessage {
        let types = Types::Builtin;
        DynamicMessage::from_json(types.message(type_name).unwrap(), json).unwrap()
    }

    #[test]
    fn an_empty_list_is_a_column_of_csv() {
        let csv = Show { form: Form::Csv, ..Show::default() };
        let scan = |ranges: &[f32], intensities: &[f32]| {
            let json = json!({
                "header": { "frame_id": "l" }, "ranges": ranges, "intensities": intensities,
            });
            csv.text(&message("sensor_msgs/msg/LaserScan", &json)).unwrap()
        };
        let before = "0,0,l,0.0,0.0,0.0,0.0,0.0,0.0,0.0";
        assert_eq!(scan(&[1.5, 2.0], &[]), format!("{before},1.5,2.0,\n"));
        assert_eq!(scan(&[], &[7.0]), format!("{before},,7.0\n"));
        assert_eq!(scan(&[], &[]), format!("{before},,\n"));
        // Nothing precedes the first column, so there is no comma.
        let blank = message("std_msgs/msg/Float32MultiArray", &json!({}));
        assert_eq!(csv.text(&blank).unwrap(), "0,\n");
    }

    #[test]
    fn a_field_that_is_a_list_is_shown_as_python_prints_it() {
        let field = |type_name: &str, json: serde_json::Value, field: &str, form| {
            let show = Show { form, field: Some(field.to_owned()), ..Show::default() };
            show.text(&message(type_name, &json)).unwrap()
        };
        for form in [Form::Yaml, Form::Csv] {
            let scan = |json| field("sensor_msgs/msg/LaserScan", json, "ranges", form);
            assert_eq!(
                scan(json!({ "ranges": [0.5, 0.1, "Infinity"] })),
                "array('f', [0.5, 0.10000000149011612, inf])\n"
            );
            assert_eq!(scan(json!({})), "array('f')\n");
            let grid = json!({ "data": [0, -1, 100] });
            assert_eq!(
                field("nav_msgs/msg/OccupancyGrid", grid, "data", form),
                "array('b', [0, -1, 100])\n"
            );
            let joints = json!({ "name": ["a", "it's"], "position": [1.0] });
            let joint = |name| field("sensor_msgs/msg/JointState", joints.clone(), name, form);
            assert_eq!(joint("name"), "['a', \"it's\"]\n");
            assert_eq!(joint("position"), "array('d', [1.0])\n");
        }
        // An array of fixed length is not printed as `array`.
        let camera = json!({});
        let text = field("sensor_msgs/msg/CameraInfo", camera, "k", Form::Yaml);
        assert!(text.starts_with("- 0.0\n"), "{text}");
    }
}
