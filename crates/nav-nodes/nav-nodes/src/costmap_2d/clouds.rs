//! Points of `sensor_msgs/PointCloud2`.

use periplus_msgs::sensor_msgs::{PointCloud2, PointField};

/// `PointField::FLOAT32` and `FLOAT64`.
const FLOAT32: u8 = 7;
const FLOAT64: u8 = 8;

/// Offset and type of a coordinate in a point.
#[derive(Clone, Copy)]
struct Place {
    offset: usize,
    is_double: bool,
}

/// Iterates over the points of a cloud without copying it.
/// # Errors
/// The reason, for a malformed cloud.
pub(crate) fn points(cloud: &PointCloud2) -> Result<impl Iterator<Item = [f32; 3]> + '_, String> {
    fields(cloud, ["x", "y", "z"])
}

/// Iterates over the values of fields in the points of a cloud without copying it.
/// # Errors
/// The reason, for a malformed cloud.
pub(crate) fn fields<'a, const N: usize>(
    cloud: &'a PointCloud2,
    names: [&str; N],
) -> Result<impl Iterator<Item = [f32; N]> + use<'a, N>, String> {
    let step = cloud.point_step as usize;
    let row_step = cloud.row_step as usize;
    let (width, height) = (cloud.width as usize, cloud.height as usize);
    let place = |name: &str| -> Result<Place, String> {
        let field = cloud.fields.iter().find(|field| field.name == name);
        let field: &PointField = field.ok_or_else(|| format!("it has no field `{name}`"))?;
        let (offset, is_double) = (field.offset as usize, field.datatype == FLOAT64);
        if field.datatype != FLOAT32 && !is_double {
            return Err(format!("its field `{name}` is not a floating point number"));
        }
        let length = if is_double { 8 } else { 4 };
        if offset.checked_add(length).is_none_or(|end| end > step) {
            return Err(format!("its field `{name}` goes beyond a point"));
        }
        Ok(Place { offset, is_double })
    };
    let mut places = [Place { offset: 0, is_double: false }; N];
    for (field, name) in places.iter_mut().zip(names) {
        *field = place(name)?;
    }
    let is_long_enough = width
        .checked_mul(step)
        .is_some_and(|row| row_step >= row && height.checked_mul(row_step).is_some())
        && cloud.data.len() >= height.saturating_mul(row_step);
    if !is_long_enough {
        return Err("its data is shorter than its width and height require".into());
    }
    let is_big = cloud.is_bigendian;
    Ok((0..height).flat_map(move |row| {
        let row = &cloud.data[row * row_step..row * row_step + width * step];
        row.chunks_exact(step.max(1)).map(move |point| places.map(|at| read(point, at, is_big)))
    }))
}

#[inline]
fn read(point: &[u8], Place { offset, is_double }: Place, is_big: bool) -> f32 {
    if is_double {
        let Some(bytes) = point[offset..].first_chunk() else { return f32::NAN };
        let number = if is_big { f64::from_be_bytes(*bytes) } else { f64::from_le_bytes(*bytes) };
        return number as f32;
    }
    let Some(bytes) = point[offset..].first_chunk() else { return f32::NAN };
    if is_big { f32::from_be_bytes(*bytes) } else { f32::from_le_bytes(*bytes) }
}

/// Creates a cloud with x, y and z.
pub(crate) fn cloud(points: &[[f32; 3]], header: periplus_msgs::std_msgs::Header) -> PointCloud2 {
    let field = |name: &str, offset| PointField {
        name: name.to_owned(),
        offset,
        datatype: FLOAT32,
        count: 1,
    };
    PointCloud2 {
        header,
        height: 1,
        width: points.len() as u32,
        fields: vec![field("x", 0), field("y", 4), field("z", 8)],
        is_bigendian: false,
        point_step: 12,
        row_step: 12 * points.len() as u32,
        data: points.iter().flatten().flat_map(|number| number.to_le_bytes()).collect(),
        is_dense: true,
    }
}

#[cfg(test)]
mod tests {
    use periplus_msgs::std_msgs::Header;

    use super::*;

    #[test]
    fn points_go_into_a_cloud_and_back() {
        let all = [[1.0, 2.0, 3.0], [-1.0, 0.5, 0.0]];
        let made = cloud(&all, Header::default());
        assert_eq!(points(&made).unwrap().collect::<Vec<_>>(), all);
    }

    #[test]
    fn what_cannot_be_read_is_said() {
        let mut short = cloud(&[[1.0; 3]; 4], Header::default());
        short.data.truncate(40);
        assert!(points(&short).err().unwrap().contains("shorter"));
        let mut odd = cloud(&[[1.0; 3]; 4], Header::default());
        odd.fields[2].offset = u32::MAX;
        assert!(points(&odd).err().unwrap().contains("beyond"));
        odd.fields.pop();
        assert_eq!(points(&odd).err().unwrap(), "it has no field `z`");
        let mut wide = cloud(&[[1.0; 3]; 4], Header::default());
        (wide.width, wide.height, wide.point_step) = (u32::MAX, u32::MAX, u32::MAX);
        assert!(points(&wide).is_err());
    }
}
