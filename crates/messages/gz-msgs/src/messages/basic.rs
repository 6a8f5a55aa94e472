//! Times, headers, single values.

use crate::message::{kinds, messages};

messages! {
    /// Seconds and nanoseconds.
    Time { 1 sec: i64, 2 nsec: i32 }
    /// Seconds and nanoseconds.
    Duration { 1 header: Option<Header>, 2 sec: i64, 3 nsec: i32 }
    /// Header of most messages.
    Header { 1 stamp: Option<Time>, 2 data: Vec<Map> }
    /// Entry of a header, with its values.
    Map = "Header.Map" { 1 key: String, 2 value: Vec<String> }
    /// Empty message.
    Empty { 1 unused: bool }
    /// Boolean.
    Boolean { 1 header: Option<Header>, 2 data: bool }
    /// Number.
    Int32 { 1 header: Option<Header>, 2 data: i32 }
    /// Number.
    Int64 { 1 header: Option<Header>, 2 data: i64 }
    /// Number.
    UInt32 { 1 header: Option<Header>, 2 data: u32 }
    /// Numbers.
    UInt32V = "UInt32_V" { 1 header: Option<Header>, 2 data: Vec<u32> }
    /// Number.
    UInt64 { 1 header: Option<Header>, 2 data: u64 }
    /// Number.
    Float { 1 header: Option<Header>, 2 data: f32 }
    /// Numbers.
    FloatV = "Float_V" { 1 header: Option<Header>, 2 data: Vec<f32> }
    /// Number.
    Double { 1 header: Option<Header>, 2 data: f64 }
    /// Text.
    StringMsg { 1 header: Option<Header>, 2 data: String }
    /// Texts.
    StringMsgV = "StringMsg_V" { 1 header: Option<Header>, 2 data: Vec<String> }
    /// Bytes.
    Bytes { 1 header: Option<Header>, 2 data: Vec<u8> }
    /// Red, green, blue, opacity; 0 to 1.
    Color { 1 header: Option<Header>, 2 r: f32, 3 g: f32, 4 b: f32, 5 a: f32 }
    /// Value of any type.
    Any {
        1 header: Option<Header>,
        2 r#type: AnyKind,
        3 double_value: f64,
        4 int_value: i32,
        5 string_value: String,
        6 bool_value: bool,
        7 vector3d_value: Option<super::Vector3d>,
        8 color_value: Option<Color>,
        9 pose3d_value: Option<super::Pose>,
        10 quaternion_value: Option<super::Quaternion>,
        11 time_value: Option<Time>,
    }
    /// Named values.
    Param { 1 header: Option<Header>, 2 params: Vec<NamedAny>, 3 children: Vec<Param> }
    /// Named value.
    NamedAny = "Param.ParamsEntry" { 1 key: String, 2 value: Option<Any> }
    /// List of named values.
    ParamV = "Param_V" { 1 header: Option<Header>, 2 param: Vec<Param> }
}

kinds! {
    /// Type of the value of an [`Any`].
    AnyKind {
        NONE = 0, DOUBLE = 1, INT32 = 2, STRING = 3, BOOLEAN = 4, VECTOR3D = 5, COLOR = 6,
        POSE3D = 7, QUATERNIOND = 8, TIME = 9,
    }
}

const NS_PER_S: i64 = 1_000_000_000;

impl Time {
    /// Message of a time \[ns\].
    #[must_use]
    pub fn of_ns(time_ns: i64) -> Self {
        let nsec = i32::try_from(time_ns.rem_euclid(NS_PER_S)).unwrap_or_default();
        Self { sec: time_ns.div_euclid(NS_PER_S), nsec }
    }

    /// Time \[ns\]; saturates at the limits of its range.
    #[must_use]
    pub fn ns(&self) -> i64 {
        self.sec.saturating_mul(NS_PER_S).saturating_add(self.nsec.into())
    }
}

impl Header {
    /// Header with a time \[ns\] and a frame.
    #[must_use]
    pub fn at(time_ns: i64, frame_id: &str) -> Self {
        Self { stamp: Some(Time::of_ns(time_ns)), data: Vec::new() }.with("frame_id", frame_id)
    }

    /// Adds an entry.
    #[must_use]
    pub fn with(mut self, key: &str, value: &str) -> Self {
        self.data.push(Map { key: key.to_owned(), value: vec![value.to_owned()] });
        self
    }

    /// First value of an entry.
    #[must_use]
    pub fn word(&self, key: &str) -> Option<&str> {
        let found = self.data.iter().find(|map| map.key == key)?;
        found.value.first().map(String::as_str)
    }
}

impl From<bool> for Boolean {
    fn from(data: bool) -> Self {
        Self { header: None, data }
    }
}

impl From<String> for StringMsg {
    fn from(data: String) -> Self {
        Self { header: None, data }
    }
}
