//! Values of blackboard entries and ports.

use std::any::Any;
use std::fmt;
use std::sync::Arc;

use crate::NodeStatus;

/// Value of a blackboard entry.
#[derive(Clone, Debug)]
pub enum TreeValue {
    /// Truth value.
    Bool(bool),
    /// Integer.
    Int(i64),
    /// Floating point number.
    Real(f64),
    /// Text.
    Text(Arc<str>),
    /// Any other type, such as a pose or a path.
    Object(TreeObject),
}

/// Value of a type that trees only pass on and compare, such as a message.
#[derive(Clone)]
pub struct TreeObject(Arc<dyn Opaque>);

trait Opaque: Any + Send + Sync {
    fn type_name(&self) -> &'static str;
    fn equals(&self, other: &dyn Opaque) -> bool;
    fn as_any(&self) -> &dyn Any;
}

impl<T: Any + Send + Sync + PartialEq> Opaque for T {
    fn type_name(&self) -> &'static str {
        std::any::type_name::<T>()
    }

    fn equals(&self, other: &dyn Opaque) -> bool {
        other.as_any().downcast_ref::<T>().is_some_and(|other| self == other)
    }

    fn as_any(&self) -> &dyn Any {
        self
    }
}

impl TreeObject {
    /// The value, if it has this type.
    #[must_use]
    pub fn get<T: 'static>(&self) -> Option<&T> {
        (*self.0).as_any().downcast_ref()
    }

    /// Name of the type in Rust.
    #[must_use]
    pub fn type_name(&self) -> &'static str {
        (*self.0).type_name()
    }
}

impl fmt::Debug for TreeObject {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("TreeObject").field(&self.type_name()).finish()
    }
}

impl PartialEq for TreeObject {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0) || (*self.0).equals(&*other.0)
    }
}

impl PartialEq for TreeValue {
    /// Compares type and value; two `NaN` differ.
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Bool(a), Self::Bool(b)) => a == b,
            (Self::Int(a), Self::Int(b)) => a == b,
            (Self::Real(a), Self::Real(b)) => a == b,
            (Self::Text(a), Self::Text(b)) => a == b,
            (Self::Object(a), Self::Object(b)) => a == b,
            _ => false,
        }
    }
}

impl From<bool> for TreeValue {
    fn from(value: bool) -> Self {
        Self::Bool(value)
    }
}

impl From<i64> for TreeValue {
    fn from(value: i64) -> Self {
        Self::Int(value)
    }
}

impl From<f64> for TreeValue {
    fn from(value: f64) -> Self {
        Self::Real(value)
    }
}

impl From<&str> for TreeValue {
    fn from(value: &str) -> Self {
        Self::Text(value.into())
    }
}

/// Largest magnitude below which every integer is exact in a double.
const MAX_EXACT: f64 = 9_007_199_254_740_992.0;

impl TreeValue {
    /// Value of any other type.
    #[must_use]
    pub fn object<T: Any + Send + Sync + PartialEq>(value: T) -> Self {
        Self::Object(TreeObject(Arc::new(value)))
    }

    /// The value, if it is an object of this type.
    #[must_use]
    pub fn get<T: 'static>(&self) -> Option<&T> {
        match self {
            Self::Object(object) => object.get(),
            _ => None,
        }
    }

    /// Number; truth values are 0 and 1. None for texts and objects.
    #[must_use]
    pub fn as_f64(&self) -> Option<f64> {
        match self {
            Self::Bool(value) => Some(f64::from(u8::from(*value))),
            #[allow(
                clippy::cast_precision_loss,
                reason = "the only number type of scripts is double"
            )]
            Self::Int(value) => Some(*value as f64),
            Self::Real(value) => Some(*value),
            Self::Text(_) | Self::Object(_) => None,
        }
    }

    /// Integer; a floating point number only if it is integral.
    #[must_use]
    pub fn as_i64(&self) -> Option<i64> {
        match self {
            Self::Bool(value) => Some(i64::from(*value)),
            Self::Int(value) => Some(*value),
            #[allow(clippy::cast_possible_truncation, reason = "integral and bounded")]
            Self::Real(value) => {
                (libm::trunc(*value) == *value && value.abs() <= MAX_EXACT).then_some(*value as i64)
            }
            Self::Text(_) | Self::Object(_) => None,
        }
    }

    /// Truth value: numbers are true unless zero; texts by [`parse_bool`].
    #[must_use]
    pub fn as_bool(&self) -> Option<bool> {
        match self {
            Self::Text(text) => parse_bool(text),
            other => other.as_f64().map(|number| number != 0.0),
        }
    }

    /// The text, if it is one.
    #[must_use]
    pub fn as_text(&self) -> Option<&str> {
        match self {
            Self::Text(text) => Some(text),
            _ => None,
        }
    }

    /// Text of a number or text: integers in decimal, others with six decimals. None for objects.
    #[must_use]
    pub fn to_text(&self) -> Option<String> {
        match self {
            Self::Bool(value) => Some(value.to_string()),
            Self::Int(value) => Some(value.to_string()),
            Self::Real(value) => Some(format!("{value:.6}")),
            Self::Text(text) => Some(text.to_string()),
            Self::Object(_) => None,
        }
    }

    /// Name of the type, for messages.
    #[must_use]
    pub fn type_name(&self) -> &'static str {
        match self {
            Self::Bool(_) => "bool",
            Self::Int(_) => "integer",
            Self::Real(_) => "double",
            Self::Text(_) => "string",
            Self::Object(object) => object.type_name(),
        }
    }
}

/// Truth value of a text: `true`, `TRUE`, `True`, `1` and their opposites.
#[must_use]
pub fn parse_bool(text: &str) -> Option<bool> {
    match text {
        "1" | "true" | "TRUE" | "True" => Some(true),
        "0" | "false" | "FALSE" | "False" => Some(false),
        _ => None,
    }
}

/// Type of a port: the type of the blackboard entry that it may refer to, and the conversion of literals.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PortType {
    /// Any type; entries are not checked.
    Any,
    /// Text.
    Text,
    /// Truth value.
    Bool,
    /// Integer. The name in C++ distinguishes widths, since entries of two widths conflict.
    Int(Arc<str>),
    /// Floating point number, `double` or `float`.
    Real(Arc<str>),
    /// Duration in milliseconds, as a whole number.
    Milliseconds,
    /// Status of a node.
    Status,
    /// List in text, separated by semicolons, such as `vector<int>`.
    List(Arc<str>),
    /// Any other type by its name, such as `nav_msgs/Path`.
    Object(Arc<str>),
}

impl PortType {
    /// Integer `int`.
    #[must_use]
    pub fn int() -> Self {
        Self::Int("int".into())
    }

    /// Integer `uint16`.
    #[must_use]
    pub fn uint16() -> Self {
        Self::Int("uint16".into())
    }

    /// Number `double`.
    #[must_use]
    pub fn real() -> Self {
        Self::Real("double".into())
    }

    /// Type by the name of an object.
    #[must_use]
    pub fn object(name: &str) -> Self {
        Self::Object(name.into())
    }

    /// Type of a name in C++ or of the attribute `type` of a port in a `TreeNodesModel`; empty means any.
    #[must_use]
    pub fn of_cpp(name: &str) -> Self {
        match name.trim() {
            "" | "BT::AnyTypeAllowed" | "AnyTypeAllowed" | "BT::Any" => Self::Any,
            "string" | "std::string" => Self::Text,
            "bool" => Self::Bool,
            "int" | "unsigned int" | "unsigned" | "uint8" | "uint16" | "uint16_t" | "int64"
            | "size_t" => Self::Int(name.trim().trim_end_matches("_t").into()),
            "double" | "float" => Self::Real(name.trim().into()),
            "chrono::milliseconds" | "std::chrono::milliseconds" => Self::Milliseconds,
            "NodeStatus" | "BT::NodeStatus" => Self::Status,
            "vector<int>"
            | "vector<string>"
            | "vector<double>"
            | "std::vector<int>"
            | "std::vector<std::string>"
            | "std::vector<double>" => Self::List(name.trim().into()),
            other => Self::Object(
                other.trim_start_matches("std::").replace("::msg::", "/").replace("::", "/").into(),
            ),
        }
    }

    /// Name of the type, for messages.
    #[must_use]
    pub fn name(&self) -> &str {
        match self {
            Self::Any => "any type",
            Self::Text => "string",
            Self::Bool => "bool",
            Self::Milliseconds => "milliseconds",
            Self::Status => "node status",
            Self::Int(name) | Self::Real(name) | Self::List(name) | Self::Object(name) => name,
        }
    }

    /// Value of a literal; none if the text has no value of this type. Objects are read by the registry's
    /// converters.
    #[must_use]
    pub fn parse(&self, text: &str) -> Option<TreeValue> {
        match self {
            Self::Any | Self::Text | Self::List(_) => Some(text.into()),
            Self::Bool => parse_bool(text.trim()).map(TreeValue::Bool),
            Self::Int(name) => {
                let number: i64 = text.trim().parse().ok()?;
                let is_unsigned = name.starts_with('u') || &**name == "size_t";
                (number >= 0 || !is_unsigned).then_some(TreeValue::Int(number))
            }
            Self::Real(_) => {
                text.trim().parse().ok().filter(|v: &f64| !v.is_nan()).map(TreeValue::Real)
            }
            Self::Milliseconds => text.trim().parse().ok().map(TreeValue::Int),
            Self::Status => NodeStatus::of_name(text.trim()).map(|status| status.name().into()),
            Self::Object(_) => None,
        }
    }

    /// True if entries of both types may be the same entry.
    #[must_use]
    pub fn agrees(&self, other: &Self) -> bool {
        matches!((self, other), (Self::Any, _) | (_, Self::Any)) || self == other
    }
}

/// Parts of a text that semicolons separate, without surrounding white space.
pub(crate) fn list_parts(text: &str) -> impl Iterator<Item = &str> {
    text.split(';').map(str::trim).filter(|part| !part.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn literals_are_converted_by_type() {
        let check = |cpp: &str, text: &str, expected: Option<TreeValue>| {
            assert_eq!(PortType::of_cpp(cpp).parse(text), expected, "{cpp} {text}");
        };
        check("double", "0.30", Some(TreeValue::Real(0.3)));
        check("double", "-1", Some(TreeValue::Real(-1.0)));
        check("double", "fast", None);
        check("int", "-3", Some(TreeValue::Int(-3)));
        check("unsigned int", "-3", None);
        check("bool", "True", Some(TreeValue::Bool(true)));
        check("bool", "yes", None);
        check("string", "map", Some("map".into()));
        check("nav_msgs::msg::Path", "x", None);
        check("chrono::milliseconds", "20", Some(TreeValue::Int(20)));
        assert_eq!(PortType::of_cpp("nav_msgs::msg::Path").name(), "nav_msgs/Path");
    }

    #[test]
    fn objects_are_compared_by_type_and_value() {
        let pose = |x: i32| TreeValue::object((x, "map"));
        assert_eq!(pose(1), pose(1));
        assert_ne!(pose(1), pose(2));
        assert_ne!(pose(1), TreeValue::object(1_i32));
        assert_eq!(pose(1).get::<(i32, &str)>(), Some(&(1, "map")));
        assert_eq!(pose(1).get::<i32>(), None);
    }
}
