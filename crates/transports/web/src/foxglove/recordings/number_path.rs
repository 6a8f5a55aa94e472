//! Numbers of messages by path.

use periplus_msgs::{DynamicMessage, Layout, Number, NumberVec, Value};

/// Path of a number in a message, such as `twist.twist.linear.x`, `ranges[3]` or
/// `pose.orientation.yaw`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct NumberPath(Vec<String>);

impl NumberPath {
    pub(super) fn new(path: &str) -> Self {
        let parts = path.split(['.', '[', ']']).filter(|part| !part.is_empty());
        Self(parts.map(str::to_owned).collect())
    }

    /// The number in a message; NaN if there is none.
    pub(super) fn number(&self, message: &DynamicMessage) -> f64 {
        in_fields(message.layout(), message.fields(), &self.0).unwrap_or(f64::NAN)
    }
}

fn in_fields(layout: &Layout, fields: &[Value], path: &[String]) -> Option<f64> {
    let (name, rest) = path.split_first()?;
    let Some(index) = layout.fields().position(|field| field == name) else {
        return if name == "yaw" && rest.is_empty() { yaw_rad(layout, fields) } else { None };
    };
    match (fields.get(index)?, layout.nested(name)) {
        (Value::Number(number), _) if rest.is_empty() => Some(as_f64(*number)),
        (Value::Numbers(numbers), _) => {
            let [index] = rest else { return None };
            element(numbers, index.parse().ok()?)
        }
        (Value::Struct(fields), Some(layout)) => in_fields(layout, fields, rest),
        (Value::List(list), Some(layout)) => {
            let (index, rest) = rest.split_first()?;
            match list.get(index.parse::<usize>().ok()?)? {
                Value::Struct(fields) => in_fields(layout, fields, rest),
                _ => None,
            }
        }
        _ => None,
    }
}

/// Yaw of a quaternion \[rad\].
fn yaw_rad(layout: &Layout, fields: &[Value]) -> Option<f64> {
    let part = |name: &str| in_fields(layout, fields, &[name.to_owned()]);
    let (x, y, z, w) = (part("x")?, part("y")?, part("z")?, part("w")?);
    Some(libm::atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z)))
}

fn element(numbers: &NumberVec, index: usize) -> Option<f64> {
    numbers.borrow().get(index).map(as_f64)
}

#[expect(clippy::cast_precision_loss, reason = "numbers to be drawn")]
fn as_f64(number: Number) -> f64 {
    match number {
        Number::Bool(value) => f64::from(u8::from(value)),
        Number::I8(value) => value.into(),
        Number::U8(value) => value.into(),
        Number::I16(value) => value.into(),
        Number::U16(value) => value.into(),
        Number::I32(value) => value.into(),
        Number::U32(value) => value.into(),
        Number::I64(value) => value as f64,
        Number::U64(value) => value as f64,
        Number::F32(value) => value.into(),
        Number::F64(value) => value,
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_1_SQRT_2;

    use periplus_msgs::Message;
    use periplus_msgs::nav_msgs::Odometry;
    use periplus_msgs::sensor_msgs::LaserScan;
    use periplus_msgs::tf2_msgs::TFMessage;

    use super::*;

    #[track_caller]
    fn check<T: Message>(message: &T, path: &str, expected: f64) {
        let message = DynamicMessage::of(message).expect("a message");
        let number = NumberPath::new(path).number(&message);
        let is_same = (number - expected).abs() < 1e-6 || number.is_nan() && expected.is_nan();
        assert!(is_same, "{path}: {number}");
    }

    #[test]
    fn numbers_are_found_by_field_and_index() {
        let scan = LaserScan { ranges: vec![1.0, 2.5], ..LaserScan::default() };
        check(&scan, "ranges[1]", 2.5);
        check(&scan, "ranges.1", 2.5);
        check(&scan, "ranges[2]", f64::NAN);
        check(&scan, "ranges", f64::NAN);
        check(&scan, "header.frame_id", f64::NAN);
        check(&scan, "nothing", f64::NAN);
        check(&scan, "", f64::NAN);
        let mut odometry = Odometry::default();
        odometry.twist.twist.linear.x = 0.5;
        odometry.pose.covariance[35] = 7.0;
        check(&odometry, "twist.twist.linear.x", 0.5);
        check(&odometry, "pose.covariance[35]", 7.0);
        check(&odometry, "twist.twist.linear.x.y", f64::NAN);
        let transforms = TFMessage { transforms: vec![Default::default(); 2] };
        check(&transforms, "transforms[1].transform.rotation.w", 1.0);
        check(&transforms, "transforms[2].transform.rotation.w", f64::NAN);
    }

    #[test]
    fn a_quaternion_has_a_yaw() {
        let mut odometry = Odometry::default();
        odometry.pose.pose.orientation.z = FRAC_1_SQRT_2;
        odometry.pose.pose.orientation.w = FRAC_1_SQRT_2;
        check(&odometry, "pose.pose.orientation.yaw", std::f64::consts::FRAC_PI_2);
        check(&odometry, "pose.pose.position.yaw", f64::NAN);
    }
}
