//! `<imu>`.

use periplus_scene::ImuSpec;
use periplus_xml::Element;

use super::noise;
use crate::fields::Fields;

pub(crate) fn read_imu(mut fields: Fields<'_, '_>) -> ImuSpec {
    let mut imu = ImuSpec {
        angular_velocity: noise::group(&mut fields, "angular_velocity", ["x", "y", "z"]),
        linear_acceleration: noise::group(&mut fields, "linear_acceleration", ["x", "y", "z"]),
        enable_orientation: fields.boolean("enable_orientation", true),
        localization: None,
        extra: Vec::new(),
    };
    if let Some(mut frame) = fields.open("orientation_reference_frame") {
        imu.localization = frame.text("localization");
        frame.verbatim(&["custom_rpy", "grav_dir_x"]);
        let rest = frame.finish();
        fields.close("orientation_reference_frame", rest);
    }
    // SDF 1.3 to 1.6 had a `<topic>` in the IMU; the placeholder has no meaning.
    let placeholder = |element: &Element| {
        element.name == "topic" && matches!(&*element.text(), "" | "__default_topic__")
    };
    fields.verbatim(&["topic"]);
    imu.extra = fields.finish();
    imu.extra.retain(|element| !placeholder(element));
    imu
}
