//! Pictures of maps and costmaps, with paths and goals.

use std::fmt::Write as _;

use periplus_geometry::{Pose2, encode_base64};
use periplus_grid::{Grid, GridInfo, OccupancyGrid};
use periplus_images::{Layout, write_png};
use periplus_maps::from_message;
use periplus_maps::palette::{Scheme, paint};
use periplus_msgs::nav_msgs;
use periplus_session::difference::last_map;
use periplus_session::recorded::{each, has_type};

use super::OpenRun;
use super::goals::goal_poses;
use super::html::{Section, escape, paragraph};
use super::plot::key;
use crate::error::CliError;

/// Longest side of a picture \[px\].
const MAX_SIDE_PX: usize = 1600;

/// Maximum number of poses of a path.
const MAX_POSE_COUNT: usize = 3000;

/// Maximum number of costmaps.
const MAX_COSTMAP_COUNT: usize = 4;

/// Border around paths without a map \[m\].
const BORDER_M: f64 = 1.0;

/// Lengths of the scale bar \[m\].
const SCALES_M: [f64; 8] = [0.1, 0.5, 1.0, 2.0, 5.0, 10.0, 50.0, 100.0];

/// Path with its name and number of its colour.
pub(super) struct NamedPath {
    pub(super) name: String,
    pub(super) colour: usize,
    pub(super) points_m: Vec<[f64; 2]>,
}

/// The last map with the path of the robot and its goals.
pub(super) fn section(run: &OpenRun) -> Result<Option<Section>, CliError> {
    let map = last_map(&run.bag)?;
    let goals = goal_poses(&run.bag)?;
    let paths = paths(run);
    if map.is_none() && paths.is_empty() {
        return Ok(None);
    }
    let title = run.heading("Map");
    let body = match &map {
        Some(map) => {
            let info = map.info;
            let text = format!(
                "The last map of the recording: {} x {} cells of {} m.",
                info.width, info.height, info.resolution_m
            );
            paragraph(&text) + &figure(Some(map), &paths, &goals)
        }
        None => paragraph("The recording has no map.") + &figure(None, &paths, &goals),
    };
    Ok(Some(Section { title, body }))
}

/// Returns the path of the robot in the map, or else by odometry.
pub(super) fn paths(run: &OpenRun) -> Vec<NamedPath> {
    let Some(base) = run.base() else { return Vec::new() };
    let of = |frame: &str, name: &str, colour| {
        let track = run.frames.track(frame, &base, MAX_POSE_COUNT);
        let points_m = track.iter().map(|(_, pose)| [pose.x_m, pose.y_m]).collect();
        NamedPath { name: name.to_owned(), colour, points_m }
    };
    let in_map = of("map", "path in the map", 0);
    if !in_map.points_m.is_empty() {
        return vec![in_map];
    }
    vec![of("odom", "path by odometry", 1)]
        .into_iter()
        .filter(|it| !it.points_m.is_empty())
        .collect()
}

/// Returns a figure of a map from above.
pub(super) fn figure(
    map: Option<&OccupancyGrid>,
    paths: &[NamedPath],
    goals: &[[f64; 2]],
) -> String {
    let info = match map {
        Some(map) => map.info,
        None => match around(paths) {
            Some(info) => info,
            None => return String::new(),
        },
    };
    let (width, height) = (info.width as f64, info.height as f64);
    let mut svg =
        format!("<svg class=\"floor\" viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"");
    let mut text = String::from(if map.is_some() { "Map from above" } else { "Floor from above" });
    for path in paths {
        let _ = write!(text, ", {}", path.name);
    }
    if !goals.is_empty() {
        let _ = write!(text, ", {} goals", goals.len());
    }
    let _ = writeln!(svg, "{}\">", escape(&text));
    if let Some(map) = map {
        svg.push_str(&image(&picture_of(map, Scheme::Map), (width, height), "map"));
    }
    let world_from_grid = info.origin;
    let pixel = |[x, y]: [f64; 2]| {
        let point = world_from_grid.inverse() * Pose2::new(x, y, 0.0);
        (point.x_m / info.resolution_m, height - point.y_m / info.resolution_m)
    };
    let size = width.max(height);
    for path in paths {
        let _ = write!(svg, "<polyline class=\"path s{}\" points=\"", path.colour);
        for point in &path.points_m {
            let (x, y) = pixel(*point);
            let _ = write!(svg, "{x:.1},{y:.1} ");
        }
        svg.push_str("\"/>\n");
        if let (Some(first), Some(last)) = (path.points_m.first(), path.points_m.last()) {
            let (x, y) = pixel(*first);
            let radius = size / 140.0;
            let _ = writeln!(
                svg,
                "<circle class=\"f{}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius:.2}\"/>",
                path.colour
            );
            let (x, y) = pixel(*last);
            let side = 2.0 * radius;
            let _ = writeln!(
                svg,
                "<rect class=\"f{}\" x=\"{:.1}\" y=\"{:.1}\" width=\"{side:.2}\" height=\"{side:.2}\"/>",
                path.colour,
                x - radius,
                y - radius
            );
        }
    }
    for goal in goals {
        let (x, y) = pixel(*goal);
        let arm = size / 60.0;
        let _ = writeln!(
            svg,
            "<path class=\"path\" stroke=\"var(--bad)\" d=\"M{:.1} {:.1}l{:.2} {:.2}m0 {:.2}l{:.2} {:.2}\"/>",
            x - arm / 2.0,
            y - arm / 2.0,
            arm,
            arm,
            -arm,
            -arm,
            arm
        );
    }
    svg.push_str("</svg>\n");
    let width_m = width * info.resolution_m;
    let scale_m = SCALES_M.iter().rev().find(|it| **it <= width_m / 4.0).unwrap_or(&SCALES_M[0]);
    let mut legend = String::from("<figcaption><ul class=\"legend\">");
    for path in paths {
        let _ = write!(
            legend,
            "<li>{}{} (circle: start, square: end)</li>",
            key(path.colour),
            escape(&path.name)
        );
    }
    if !goals.is_empty() {
        legend.push_str("<li><span class=\"error\" aria-hidden=\"true\">×</span> goal</li>");
    }
    let _ = write!(
        legend,
        "</ul><svg viewBox=\"0 0 {width} {:.2}\" role=\"img\" aria-label=\"Scale: {scale_m} m\"><line class=\"path\" \
         stroke=\"var(--text)\" x1=\"0\" x2=\"{:.2}\" y1=\"50%\" y2=\"50%\"/></svg>The line above is {scale_m} m \
         long; the picture is {width_m:.1} m wide.</figcaption>",
        width / 50.0,
        scale_m / info.resolution_m
    );
    format!("<figure>{svg}{legend}</figure>\n")
}

/// Grid around paths, with cells of a thousandth of the longer side.
fn around(paths: &[NamedPath]) -> Option<GridInfo> {
    let points = || paths.iter().flat_map(|path| &path.points_m);
    let first = points().next()?;
    let low = points().fold(*first, |a, b| [a[0].min(b[0]), a[1].min(b[1])]);
    let high = points().fold(*first, |a, b| [a[0].max(b[0]), a[1].max(b[1])]);
    let size = [0, 1].map(|axis| high[axis] - low[axis] + 2.0 * BORDER_M);
    let side_m = size[0].max(size[1]) / 1000.0;
    let origin = Pose2::new(low[0] - BORDER_M, low[1] - BORDER_M, 0.0);
    let [width, height] = size.map(|length_m| (length_m / side_m).ceil() as usize);
    GridInfo::new(side_m, width, height, origin).ok()
}

/// Returns an `<image>` with the bytes of a PNG.
pub(super) fn image(png: &[u8], (width, height): (f64, f64), class: &str) -> String {
    format!(
        "<image class=\"{class}\" width=\"{width}\" height=\"{height}\" preserveAspectRatio=\"none\" \
         href=\"data:image/png;base64,{}\"/>\n",
        encode_base64(png)
    )
}

/// Returns a PNG of a grid; of large ones each pixel has the highest value of its cells.
fn picture_of(map: &OccupancyGrid, scheme: Scheme) -> Vec<u8> {
    let GridInfo { width, height, .. } = map.info;
    let every = width.max(height).div_ceil(MAX_SIDE_PX).max(1);
    let (columns, rows) = (width.div_ceil(every), height.div_ceil(every));
    let mut values = vec![-1_i8; columns * rows];
    for row in 0..height {
        for column in 0..width {
            let pixel = &mut values[row / every * columns + column / every];
            *pixel = (*pixel).max(map[(column, row)]);
        }
    }
    let samples = paint(&scheme.palette(), columns, &values, 1);
    let side = |it: usize| u32::try_from(it).unwrap_or(u32::MAX);
    write_png(side(columns), side(rows), Layout::Rgb, &samples)
}

/// The last costmaps.
pub(super) fn costmaps(run: &OpenRun) -> Result<Option<Section>, CliError> {
    let topics = run.bag.topics().iter().zip(run.bag.counts()).filter(|(topic, count)| {
        **count > 0 && topic.name.ends_with("/costmap") && has_type(topic, "OccupancyGrid")
    });
    let mut body = String::new();
    for (topic, _) in topics.take(MAX_COSTMAP_COUNT) {
        let mut last = None;
        each::<nav_msgs::OccupancyGrid>(&run.bag, &[topic.name.as_str()], |_, map| {
            last = Some(map);
        })?;
        let Some(map) = last.and_then(|map| from_message(&map).ok()) else { continue };
        let size = (map.info.width as f64, map.info.height as f64);
        let name = escape(&topic.name);
        let _ = writeln!(
            body,
            "<figure><h3>{name}</h3><svg class=\"floor\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"Costmap \
             {name} from above\">{}</svg><figcaption>{} x {} cells of {} m. Magenta: lethal; cyan: inscribed; \
             red to blue: decreasing costs; white: free; grey: unknown.</figcaption></figure>",
            size.0,
            size.1,
            image(&picture_of(&map, Scheme::Costmap), size, "costmap"),
            map.info.width,
            map.info.height,
            map.info.resolution_m
        );
    }
    let section = Section {
        title: run.heading("Costmaps"),
        body: format!("<div class=\"figures\">{body}</div>\n"),
    };
    Ok((!body.is_empty()).then_some(section))
}

/// Returns a PNG of colours, from the lowest row.
pub(super) fn picture_of_colours(colours: &Grid<[u8; 3]>) -> Vec<u8> {
    let GridInfo { width, height, .. } = colours.info;
    let every = width.max(height).div_ceil(MAX_SIDE_PX).max(1);
    let (columns, rows) = (width.div_ceil(every), height.div_ceil(every));
    let mut samples = Vec::with_capacity(3 * columns * rows);
    for row in (0..rows).rev() {
        for column in 0..columns {
            samples.extend_from_slice(&colours[(column * every, row * every)]);
        }
    }
    let side = |it: usize| u32::try_from(it).unwrap_or(u32::MAX);
    write_png(side(columns), side(rows), Layout::Rgb, &samples)
}
