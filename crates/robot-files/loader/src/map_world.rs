//! Conversion of an occupancy grid to a world.

use std::fmt::Write as _;

use periplus_geometry::format_number;
use periplus_grid::OccupancyGrid;
use periplus_maps::wall_boxes;

/// Systems needed by robots with sensors in Gazebo Harmonic, a light, and the floor.
const HEAD: &str = r#"    <plugin filename="gz-sim-physics-system" name="gz::sim::systems::Physics"/>
    <plugin filename="gz-sim-user-commands-system" name="gz::sim::systems::UserCommands"/>
    <plugin filename="gz-sim-scene-broadcaster-system" name="gz::sim::systems::SceneBroadcaster"/>
    <plugin filename="gz-sim-contact-system" name="gz::sim::systems::Contact"/>
    <plugin filename="gz-sim-imu-system" name="gz::sim::systems::Imu"/>
    <plugin filename="gz-sim-sensors-system" name="gz::sim::systems::Sensors">
      <render_engine>ogre2</render_engine>
    </plugin>
    <light name="sun" type="directional">
      <pose>0 0 10 0 0 0</pose>
      <cast_shadows>true</cast_shadows>
      <diffuse>0.8 0.8 0.8 1</diffuse>
      <specular>0.2 0.2 0.2 1</specular>
      <direction>-0.5 0.1 -0.9</direction>
    </light>
"#;

/// Margin of the floor around the map [m].
const FLOOR_MARGIN_M: f64 = 5.0;

/// Returns the SDF of a world named `name`: a floor, and a static model `map` with boxes of `wall_height_m`
/// on the occupied cells. The world frame is the map frame, so poses are valid in both; unknown and free
/// cells are empty. Also returns the number of boxes.
#[must_use]
pub fn map_world(map: &OccupancyGrid, name: &str, wall_height_m: f64) -> (String, usize) {
    let info = &map.info;
    let boxes = wall_boxes(map);
    let mut text = String::from("<?xml version=\"1.0\"?>\n<sdf version=\"1.9\">\n");
    let _ = writeln!(text, "  <world name=\"{}\">", escaped(name));
    text.push_str(HEAD);
    floor(map, &mut text);
    let (x, y, yaw) = (info.origin.x_m, info.origin.y_m, info.origin.yaw_rad);
    let _ = writeln!(
        text,
        "    <model name=\"map\">\n      <static>true</static>\n      <pose>{} {} 0 0 0 {}</pose>\n      \
         <link name=\"walls\">",
        format_number(x),
        format_number(y),
        format_number(yaw)
    );
    let metres = |cells: f64| format_number(rounded(cells * info.resolution_m));
    for (index, one) in boxes.iter().enumerate() {
        let middle = |first: usize, count: usize| {
            #[expect(clippy::cast_precision_loss, reason = "cells are below 2^28")]
            metres(first as f64 + count as f64 / 2.0)
        };
        #[expect(clippy::cast_precision_loss, reason = "cells are below 2^28")]
        let size = [metres(one.columns as f64), metres(one.rows as f64)];
        let (x, y) = (middle(one.column, one.columns), middle(one.row, one.rows));
        for part in ["collision", "visual"] {
            let look = match part {
                "visual" => {
                    "<material><ambient>0.7 0.7 0.65 1</ambient>\
                     <diffuse>0.7 0.7 0.65 1</diffuse></material>"
                }
                _ => "",
            };
            let _ = writeln!(
                text,
                "        <{part} name=\"wall_{index}\"><pose>{x} {y} {} 0 0 0</pose><geometry><box>\
                 <size>{} {} {}</size></box></geometry>{look}</{part}>",
                format_number(rounded(wall_height_m / 2.0)),
                size[0],
                size[1],
                format_number(wall_height_m)
            );
        }
    }
    text.push_str("      </link>\n    </model>\n  </world>\n</sdf>\n");
    (text, boxes.len())
}

/// Floor below the whole map, with a margin.
fn floor(map: &OccupancyGrid, text: &mut String) {
    let (width_m, height_m) = map.info.size_m();
    #[expect(clippy::cast_precision_loss, reason = "cells are below 2^28")]
    let middle = map.info.point_at(map.info.width as f64 / 2.0, map.info.height as f64 / 2.0);
    // Large enough for any yaw.
    let side = (libm::hypot(width_m, height_m) + 2.0 * FLOOR_MARGIN_M).ceil();
    let plane = format!(
        "<geometry><plane><normal>0 0 1</normal><size>{0} {0}</size></plane></geometry>",
        format_number(side)
    );
    let _ = writeln!(
        text,
        "    <model name=\"floor\">\n      <static>true</static>\n      <pose>{} {} 0 0 0 0</pose>\n      \
         <link name=\"link\">\n        <collision name=\"collision\">{plane}</collision>\n        \
         <visual name=\"visual\">{plane}<material><ambient>0.45 0.45 0.45 1</ambient>\
         <diffuse>0.45 0.45 0.45 1</diffuse></material></visual>\n      </link>\n    </model>",
        format_number(rounded(middle.0)),
        format_number(rounded(middle.1))
    );
}

/// Rounds to micrometres to keep the text short.
fn rounded(length_m: f64) -> f64 {
    (length_m * 1e6).round() / 1e6 + 0.0
}

fn escaped(name: &str) -> String {
    name.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;").replace("::", "__")
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use periplus_geometry::Pose2;
    use periplus_grid::{Grid, GridInfo};
    use periplus_resources::{MemoryHost, Resolver};
    use periplus_scene::Shape;

    use super::*;
    use crate::{LoadContext, load_bytes};

    /// Distance along a ray to the first of the boxes (slab method, Kay and Kajiya 1986).
    fn range_to_boxes_m(boxes: &[([f64; 2], [f64; 2])], from: [f64; 2], along: [f64; 2]) -> f64 {
        let hits = boxes.iter().filter_map(|(low, high)| {
            let (mut near, mut far) = (0.0_f64, f64::INFINITY);
            for axis in 0..2 {
                let ends = [low, high].map(|end| (end[axis] - from[axis]) / along[axis]);
                near = near.max(ends[0].min(ends[1]));
                far = far.min(ends[0].max(ends[1]));
            }
            (near <= far).then_some(near)
        });
        hits.fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn scans_agree_with_the_map_within_half_a_cell() {
        const RESOLUTION_M: f64 = 0.05;
        let info = GridInfo::new(RESOLUTION_M, 80, 60, Pose2::default()).expect("a valid grid");
        // A room with a slanted wall and a few single cells.
        let is_wall = |x: usize, y: usize| {
            x == 0
                || y == 0
                || x == 79
                || y == 59
                || (x + 2 * y == 130)
                || (x * 7 + y * 13).is_multiple_of(211)
        };
        let cells = (0..4800).map(|i| if is_wall(i % 80, i / 80) { 100 } else { 0 }).collect();
        let map: OccupancyGrid = Grid::from_cells(info, cells).expect("as many cells");
        let (text, _) = map_world(&map, "room", 2.0);
        let host = MemoryHost::new();
        let setting = LoadContext {
            host: &host,
            resolver: &Resolver::new(&host, &[]),
            working_folder: "/".into(),
            arguments: Vec::new(),
            open_meshes: false,
        };
        let loaded = load_bytes(Path::new("room.sdf"), text.as_bytes(), &setting);
        let world = loaded.scene.expect("a scene").worlds.remove(0);
        let model = world.models.iter().find(|model| model.name == "map").expect("the map");
        let boxes: Vec<([f64; 2], [f64; 2])> = model.links[0]
            .collisions
            .iter()
            .map(|one| {
                let Shape::Box { size_m } = one.shape else { panic!("no box") };
                let (at, half) = (one.link_from_collision.translation, size_m * 0.5);
                ([at.x - half.x, at.y - half.y], [at.x + half.x, at.y + half.y])
            })
            .collect();
        let from = [1.23, 1.31];
        for beam in 0..360 {
            let (sine, cosine) = libm::sincos((f64::from(beam) + 0.3).to_radians());
            let range_m = range_to_boxes_m(&boxes, from, [cosine, sine]);
            let steps = (0..).map(|step| f64::from(step) * 0.001);
            let is_hit = |along: &f64| {
                map.at(from[0] + along * cosine, from[1] + along * sine) == Some(&100)
            };
            let in_map_m = steps.take(10_000).find(is_hit).expect("a wall");
            assert!(
                (range_m - in_map_m).abs() <= RESOLUTION_M / 2.0,
                "beam {beam}: {range_m} {in_map_m}"
            );
        }
    }

    #[test]
    fn the_boxes_are_where_the_cells_are() {
        let origin = Pose2 { x_m: -1.0, y_m: 2.0, yaw_rad: 0.5 };
        let info = GridInfo::new(0.05, 40, 30, origin).expect("a valid grid");
        let cells = (0..1200).map(|i| if i % 7 == 0 || i / 40 == 3 { 100 } else { 0 }).collect();
        let map: OccupancyGrid = Grid::from_cells(info, cells).expect("as many cells");
        let (text, count) = map_world(&map, "a \"plan\" & b::c", 2.5);
        let host = MemoryHost::new();
        let setting = LoadContext {
            host: &host,
            resolver: &Resolver::new(&host, &[]),
            working_folder: "/".into(),
            arguments: Vec::new(),
            open_meshes: false,
        };
        let loaded = load_bytes(Path::new("plan.sdf"), text.as_bytes(), &setting);
        assert!(loaded.diagnostics.is_empty(), "{:?}", loaded.diagnostics);
        let world = &loaded.scene.expect("a scene").worlds[0];
        assert_eq!(world.name, "a \"plan\" & b__c");
        let model = world.models.iter().find(|model| model.name == "map").expect("the map");
        let walls = &model.links[0];
        assert_eq!((walls.collisions.len(), walls.visuals.len()), (count, count));
        // The middle of each cell is inside a box exactly if the cell is a wall.
        for (index, value) in map.cells.iter().enumerate() {
            let (x, y) = map.info.centre_of(map.info.cell(index));
            let inside = walls.collisions.iter().any(|one| {
                let world_from_box = model.parent_from_model * one.link_from_collision;
                let box_from_world = world_from_box.inverse();
                let point = box_from_world.translation
                    + box_from_world.rotation * periplus_geometry::DVec3::new(x, y, 1.0);
                let Shape::Box { size_m } = &one.shape else { return false };
                point.abs().cmple(*size_m * 0.5).all()
            });
            assert_eq!(inside, *value == 100, "cell {index}");
        }
    }
}
