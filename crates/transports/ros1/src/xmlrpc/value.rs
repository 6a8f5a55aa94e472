//! Values.

use std::collections::BTreeMap;

/// A value of XML-RPC.
#[derive(Clone, Debug, PartialEq)]
pub enum XmlRpcValue {
    /// `i4` or `int`.
    Int(i32),
    /// `boolean`.
    Bool(bool),
    /// `string`.
    Text(String),
    /// `double`.
    Double(f64),
    /// `dateTime.iso8601`, as it is written.
    Time(String),
    /// `base64`.
    Binary(Vec<u8>),
    /// `array`.
    List(Vec<XmlRpcValue>),
    /// `struct`.
    Struct(BTreeMap<String, XmlRpcValue>),
}

impl XmlRpcValue {
    /// The text; none for other values.
    #[must_use]
    pub fn text(&self) -> Option<&str> {
        match self {
            Self::Text(text) => Some(text),
            _ => None,
        }
    }

    /// The list; none for other values.
    #[must_use]
    pub fn list(&self) -> Option<&[Self]> {
        match self {
            Self::List(list) => Some(list),
            _ => None,
        }
    }

    /// The integer; none for other values.
    #[must_use]
    pub fn int(&self) -> Option<i32> {
        match self {
            Self::Int(int) => Some(*int),
            _ => None,
        }
    }

    /// Name of its type, as in error texts.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Int(_) => "an integer",
            Self::Bool(_) => "a boolean",
            Self::Text(_) => "a string",
            Self::Double(_) => "a number",
            Self::Time(_) => "a time",
            Self::Binary(_) => "binary data",
            Self::List(_) => "a list",
            Self::Struct(_) => "a dictionary",
        }
    }
}

impl From<&str> for XmlRpcValue {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<String> for XmlRpcValue {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl From<f64> for XmlRpcValue {
    fn from(number: f64) -> Self {
        Self::Double(number)
    }
}

impl From<i32> for XmlRpcValue {
    fn from(int: i32) -> Self {
        Self::Int(int)
    }
}

impl From<bool> for XmlRpcValue {
    fn from(is_true: bool) -> Self {
        Self::Bool(is_true)
    }
}

impl<T: Into<Self>> From<Vec<T>> for XmlRpcValue {
    fn from(list: Vec<T>) -> Self {
        Self::List(list.into_iter().map(Into::into).collect())
    }
}
