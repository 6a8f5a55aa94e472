//! How messages are shown: YAML comes from `msgs`, the other forms from here. Each is one walk over
//! the values; what is cut is cut before it is made into text.

mod csv;
mod json;
mod python;

use periplus_msgs::{DynamicMessage, Number, Part, Sink, Value, YamlStyle};

use crate::{Failure, Outcome};

pub use python::repr;
pub(crate) use python::{float as python_float, text as python_text};

/// The form in which messages are shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Form {
    /// As people read them.
    #[default]
    Yaml,
    /// All values of a message on one line, with commas between.
    Csv,
    /// A JSON object on one line.
    Json,
}

/// How messages are shown.
#[derive(Clone, Debug, Default)]
pub struct Show {
    /// The form.
    pub form: Form,
    /// What is cut or left out.
    pub style: YamlStyle,
    /// Only this part, such as `pose.pose.position` or `ranges[0]`.
    pub field: Option<String>,
}

impl Show {
    /// A message, with the end of its last line, without anything between messages.
    ///
    /// # Errors
    /// When it has no such part.
    pub fn text(&self, message: &DynamicMessage) -> Outcome<String> {
        match &self.field {
            None => Ok(self.whole(message)),
            Some(path) => {
                let part = message.part(path).map_err(|error| {
                    let name = message.layout().type_name();
                    Failure::failed(format!("{name} has nothing called `{path}`: {error}"))
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
            // As Python prints it, not as YAML: the answer to `--field` is for scripts.
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
                sink.out
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

/// What a list is cut to.
fn shown(length: usize, longest: Option<usize>) -> usize {
    longest.map_or(length, |longest| longest.min(length))
}

/// The first characters of a text, and whether there are more.
fn cut(text: &str, longest: Option<usize>) -> (&str, bool) {
    match longest.and_then(|longest| text.char_indices().nth(longest)) {
        Some((end, _)) => (&text[..end], true),
        None => (text, false),
    }
}

/// Whether a number is a whole one, and which.
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

/// A whole number as it is.
pub(crate) fn whole_number(number: Number) -> i128 {
    whole(number).unwrap_or(0)
}
