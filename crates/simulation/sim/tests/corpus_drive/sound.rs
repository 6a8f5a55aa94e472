//! Checks that all numbers of a message are finite.

use periplus_graph::Sample;
use periplus_msgs::sensor_msgs::{Image, LaserScan, PointCloud2, PointField, Range};
use periplus_msgs::{DynamicMessage, Format, Message, Number, Numbers, TypeRegistry, Value};

/// Error of a message, if it has one. Infinities are valid in ranges and depths beyond the limits, as
/// defined by REP 117 and 118.
pub(crate) fn fault(type_name: &str, sample: &Sample) -> Option<String> {
    let found = match type_name {
        LaserScan::TYPE_NAME => sample.message().map(|scan| scan_fault(&scan)),
        Range::TYPE_NAME => sample.message().map(|range| range_fault(&range)),
        PointCloud2::TYPE_NAME => sample.message().map(|cloud| cloud_fault(&cloud)),
        Image::TYPE_NAME => sample.message().map(|image| image_fault(&image)),
        // The states of interfaces that a joint lacks are NaN, as `joint_state_broadcaster` has them.
        "sensor_msgs/msg/JointState" | "control_msgs/msg/DynamicJointState" => Ok(None),
        _ => other_fault(type_name, sample),
    };
    found.unwrap_or_else(|error| Some(format!("it cannot be read: {error}")))
}

fn scan_fault(scan: &LaserScan) -> Option<String> {
    let frame = [scan.angle_min, scan.angle_max, scan.angle_increment, scan.time_increment];
    let limits = [scan.scan_time, scan.range_min, scan.range_max];
    if !frame.iter().chain(&limits).chain(&scan.intensities).all(|number| number.is_finite()) {
        return Some("an angle, time, limit or intensity is not a number".into());
    }
    if scan.ranges.is_empty() {
        return Some("no ranges".into());
    }
    let at = scan.ranges.iter().position(|range| range.is_nan() || (-1e30..0.0).contains(range))?;
    Some(format!("range {at} is {}", scan.ranges[at]))
}

fn range_fault(range: &Range) -> Option<String> {
    let others = [range.field_of_view, range.min_range, range.max_range];
    let sound = others.iter().all(|number| number.is_finite()) && !range.range.is_nan();
    (!sound).then(|| format!("the range is {}", range.range))
}

/// A point without a return has no numbers; the cloud must then have `is_dense` false.
fn cloud_fault(cloud: &PointCloud2) -> Option<String> {
    let (width, height) = (cloud.width as usize, cloud.height as usize);
    let (step, row) = (cloud.point_step as usize, cloud.row_step as usize);
    if step == 0 || row < width * step || cloud.data.len() != row * height {
        return Some(format!(
            "{width} x {height} points of {step} bytes in {} bytes",
            cloud.data.len()
        ));
    }
    let places: Vec<usize> = cloud
        .fields
        .iter()
        .filter(|field| ["x", "y", "z"].contains(&field.name.as_str()))
        .filter(|field| field.datatype == PointField::FLOAT32)
        .map(|field| field.offset as usize)
        .collect();
    if places.len() != 3 || places.iter().any(|place| place + 4 > step) {
        return Some("no x, y, z".into());
    }
    let number = |at: usize| f32::from_le_bytes(cloud.data[at..at + 4].try_into().unwrap());
    let open = (0..height)
        .flat_map(|line| (0..width).map(move |column| line * row + column * step))
        .find(|start| !places.iter().all(|place| number(start + place).is_finite()))?;
    cloud.is_dense.then(|| format!("a dense cloud with no point at byte {open}"))
}

fn image_fault(image: &Image) -> Option<String> {
    let rows = image.step as usize * image.height as usize;
    if image.data.is_empty() || image.data.len() != rows {
        return Some(format!("{} bytes in place of {rows}", image.data.len()));
    }
    if image.encoding != "32FC1" {
        return None;
    }
    let depths =
        image.data.chunks_exact(4).map(|bytes| f32::from_le_bytes(bytes.try_into().unwrap()));
    depths
        .into_iter()
        .find(|depth| depth.is_finite() && *depth < 0.0)
        .map(|depth| format!("depth {depth}"))
}

fn other_fault(
    type_name: &str,
    sample: &Sample,
) -> Result<Option<String>, periplus_msgs::DecodeError> {
    let Some(layout) = TypeRegistry::builtin().layout(type_name) else {
        return Ok(Some("its type is not known".into()));
    };
    let Ok(bytes) = sample.cdr() else { return Ok(Some("it cannot be written".into())) };
    let message = DynamicMessage::decode(layout, Format::CDR, bytes)?;
    let sound = message.fields().iter().all(is_sound);
    Ok((!sound).then(|| format!("a number is none: {}", message.to_json())))
}

fn is_sound(value: &Value) -> bool {
    match value {
        Value::Number(Number::F32(number)) => number.is_finite(),
        Value::Number(Number::F64(number)) => number.is_finite(),
        Value::Numbers(numbers) => match numbers.borrow() {
            Numbers::F32(all) => all.iter().all(|number| number.is_finite()),
            Numbers::F64(all) => all.iter().all(|number| number.is_finite()),
            _ => true,
        },
        Value::List(list) | Value::Struct(list) => list.iter().all(is_sound),
        Value::Number(_) | Value::Text(_) => true,
    }
}
