//! `<lidar>`, once `<ray>`.

use periplus_diagnostics::Diagnostic;
use periplus_scene::{LidarSpec, ScanAxis};

use super::noise;
use crate::fields::Fields;

pub(crate) fn read_lidar(mut fields: Fields<'_, '_>) -> LidarSpec {
    let horizontal = ScanAxis { samples: 640, ..SINGLE };
    let mut lidar = LidarSpec {
        horizontal,
        vertical: SINGLE,
        range_min_m: 0.0,
        range_max_m: 0.0,
        range_resolution_m: 0.0,
        noise: noise::child(&mut fields),
        visibility_mask: fields.count("visibility_mask", u32::MAX),
        extra: Vec::new(),
    };
    fields.require("scan", "one ray ahead");
    if let Some(mut scan) = fields.open("scan") {
        lidar.horizontal = axis(&mut scan, "horizontal", horizontal);
        lidar.vertical = axis(&mut scan, "vertical", SINGLE);
        let rest = scan.finish();
        fields.close("scan", rest);
    }
    read_range(&mut fields, &mut lidar);
    lidar.extra = fields.finish();
    lidar
}

const SINGLE: ScanAxis =
    ScanAxis { samples: 1, resolution: 1.0, min_angle_rad: 0.0, max_angle_rad: 0.0 };

fn axis(scan: &mut Fields<'_, '_>, name: &'static str, default: ScanAxis) -> ScanAxis {
    let Some(mut fields) = scan.open(name) else { return default };
    let mut axis = ScanAxis {
        samples: fields.count("samples", default.samples),
        resolution: fields.magnitude("resolution", 1.0),
        min_angle_rad: fields.number("min_angle", 0.0),
        max_angle_rad: fields.number("max_angle", 0.0),
    };
    let place = |fields: &Fields<'_, '_>, child| {
        fields
            .element
            .child(child)
            .map_or(fields.element.origin, periplus_xml::Element::text_origin)
    };
    if axis.samples == 0 {
        let finding = Diagnostic::error("out-of-range", "a lidar without samples measures nothing")
            .at(place(&fields, "samples"))
            .note("1 is assumed");
        fields.diagnostics.push(finding);
        axis.samples = 1;
    }
    if axis.resolution == 0.0 {
        let finding = Diagnostic::error("out-of-range", "a resolution of 0 reports no ranges")
            .at(place(&fields, "resolution"))
            .note("1 is assumed");
        fields.diagnostics.push(finding);
        axis.resolution = 1.0;
    }
    if axis.max_angle_rad < axis.min_angle_rad {
        let finding = Diagnostic::warning("out-of-range", "`<max_angle>` is below `<min_angle>`")
            .at(place(&fields, "max_angle"))
            .related(place(&fields, "min_angle"), "the minimum angle")
            .note("angles are in radians; the two are swapped");
        fields.diagnostics.push(finding);
        std::mem::swap(&mut axis.min_angle_rad, &mut axis.max_angle_rad);
    }
    let rest = fields.finish();
    scan.close(name, rest);
    axis
}

fn read_range(fields: &mut Fields<'_, '_>, lidar: &mut LidarSpec) {
    let Some(mut range) = fields.open("range") else {
        fields.diagnostics.push(
            Diagnostic::error("missing-element", "a lidar needs its `<range>`")
                .at(fields.element.origin)
                .help("add `<range><min>0.1</min><max>10</max></range>`"),
        );
        return;
    };
    let place = |fields: &Fields<'_, '_>, child| {
        fields
            .element
            .child(child)
            .map_or(fields.element.origin, periplus_xml::Element::text_origin)
    };
    lidar.range_min_m = range.limit("min", 0.0);
    lidar.range_max_m = range.limit("max", 0.0);
    lidar.range_resolution_m = range.magnitude("resolution", 0.0);
    if lidar.range_min_m < 0.0 || lidar.range_min_m.is_infinite() {
        let finding = Diagnostic::error("out-of-range", "the minimum range must be at least 0")
            .at(place(&range, "min"))
            .note("0 is assumed");
        range.diagnostics.push(finding);
        lidar.range_min_m = 0.0;
    }
    if lidar.range_max_m <= lidar.range_min_m {
        let finding = Diagnostic::error("out-of-range", "`<max>` must be above `<min>`")
            .at(place(&range, "max"))
            .related(place(&range, "min"), "the minimum range")
            .note("this lidar measures nothing");
        range.diagnostics.push(finding);
    }
    let rest = range.finish();
    fields.close("range", rest);
}
