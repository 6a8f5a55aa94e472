//! Properties of any costmap.

use periplus_costmap::layers::{InflationLayer, ObstacleLayer, VoxelLayer};
use periplus_costmap::{
    Costmap, CostmapSettings, Footprint, Layer, LayeredCostmap, Nav2Release, NoTransforms,
    Observation, ObservationSource, RangeLimits, tables,
};
use periplus_diagnostics::Diagnostics;
use periplus_geometry::Pose2;
use periplus_grid::GridInfo;
use periplus_params::{Given, ParamValues, Table};
use proptest::prelude::*;

const SIDE: usize = 40;

fn values(table: &'static Table, given: &[(&'static str, &'static str)]) -> ParamValues {
    let given = given.iter().map(|(name, text)| Given::new(name, *text));
    table.check(given, None, &mut Diagnostics::new())
}

fn costmap(is_rolling: bool) -> LayeredCostmap {
    let info = GridInfo::new(0.1, SIDE, SIDE, Pose2::IDENTITY).expect("a valid grid");
    let frame = CostmapSettings { is_rolling, ..CostmapSettings::default() };
    LayeredCostmap::new(frame, info)
}

fn seen(origin: [f64; 2], points: &[[f64; 2]]) -> Observation {
    Observation {
        time_ns: 0,
        origin: [origin[0], origin[1], 0.5],
        points: points.iter().map(|[x, y]| [*x as f32, *y as f32, 0.5]).collect(),
        marks: RangeLimits { min_m: 0.0, max_m: 100.0 },
        rays: RangeLimits { min_m: 0.0, max_m: 100.0 },
    }
}

fn obstacles(is_voxel: bool, sources: Vec<ObservationSource>) -> Box<dyn Layer> {
    if is_voxel {
        Box::new(VoxelLayer::new("seen", values(&tables::VOXEL, &[]), false, sources))
    } else {
        Box::new(ObstacleLayer::new("seen", values(&tables::OBSTACLE, &[]), false, sources))
    }
}

fn inflation(name: &str) -> Box<dyn Layer> {
    let values = values(&tables::INFLATION, &[("inflation_radius", "0.5")]);
    Box::new(InflationLayer::new(name, values, Nav2Release::Main))
}

fn point() -> impl Strategy<Value = [f64; 2]> {
    [0.01..3.99, 0.01..3.99]
}

fn points() -> impl Strategy<Value = Vec<[f64; 2]>> {
    proptest::collection::vec(point(), 1..60)
}

fn lethal(costmap: &Costmap, [x, y]: [f64; 2]) -> bool {
    costmap.cost_at((x as f32).into(), (y as f32).into()) == Some(254)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// Marks of one source stay although another source clears the same cells in the same update.
    #[test]
    fn clearing_spares_what_is_marked_in_the_same_update(
        marks in points(), clears in points(), origin in point(), is_voxel: bool,
    ) {
        let sources = vec![
            ObservationSource::fixed("marks", seen(origin, &marks), true, false),
            ObservationSource::fixed("clears", seen(origin, &clears), false, true),
        ];
        let mut costmap = costmap(false);
        costmap.add_layer(obstacles(is_voxel, sources));
        for now_ns in 0..2 {
            costmap.update(now_ns, Pose2::IDENTITY, &NoTransforms);
        }
        for mark in marks {
            prop_assert!(lethal(costmap.costmap(), mark), "{mark:?}");
        }
    }

    /// A rolling window keeps observations at their position in the world while it covers them.
    #[test]
    fn a_rolling_window_keeps_the_world_in_its_place(
        marks in points(), steps in proptest::collection::vec([-0.6..0.6, -0.6..0.6], 1..12),
        is_voxel: bool,
    ) {
        let mut costmap = costmap(true);
        let origin = [2.0, 2.0];
        // A single observation: afterwards only memory counts.
        costmap.add_layer(obstacles(is_voxel, Vec::new()));
        let mut source = ObservationSource::fixed("once", seen(origin, &marks), true, false);
        source.settings.persistence_ns = 1;
        add_source(&mut costmap, is_voxel, source);
        let mut robot = Pose2::new(2.0, 2.0, 0.0);
        costmap.update(0, robot, &NoTransforms);
        let mut remembered: Vec<(f64, f64)> = cells_with(costmap.costmap(), 254);
        prop_assert!(!remembered.is_empty());
        for (step, [dx, dy]) in steps.into_iter().enumerate() {
            robot = Pose2::new(robot.x_m + dx, robot.y_m + dy, 0.0);
            costmap.update(10 + step as i64, robot, &NoTransforms);
            let layer = costmap.layers()[0].grid().unwrap();
            remembered.retain(|(x_m, y_m)| layer.cost_at(*x_m, *y_m).is_some());
            prop_assert_eq!(cells_with(layer, 254).len(), remembered.len());
            for (x_m, y_m) in &remembered {
                prop_assert_eq!(layer.cost_at(*x_m, *y_m), Some(254));
            }
        }
    }

    /// Layers before the inflation layer are inflated, later ones are not.
    #[test]
    fn the_order_of_layers_counts(marks in points(), origin in point()) {
        let build = |inflation_first: bool| {
            let mut costmap = costmap(false);
            let layer = obstacles(false, vec![ObservationSource::fixed("a", seen(origin, &marks), true, false)]);
            if inflation_first {
                costmap.add_layer(inflation("inflation"));
                costmap.add_layer(layer);
            } else {
                costmap.add_layer(layer);
                costmap.add_layer(inflation("inflation"));
            }
            costmap.set_footprint(Footprint::circle(0.2));
            costmap.update(0, Pose2::IDENTITY, &NoTransforms);
            costmap
        };
        let (inflated, bare) = (build(false), build(true));
        let count = |costmap: &LayeredCostmap, cost| cells_with(costmap.costmap(), cost).len();
        prop_assert_eq!(count(&inflated, 254), count(&bare, 254));
        prop_assert_eq!(count(&bare, 253), 0);
        prop_assert_eq!(count(&bare, 0), SIDE * SIDE - count(&bare, 254));
        prop_assert!(count(&inflated, 0) < count(&bare, 0));
    }

    /// Incremental updates have the same result as one full update.
    #[test]
    fn updates_of_a_part_equal_one_of_all(
        rounds in proptest::collection::vec((points(), point()), 1..6),
    ) {
        let mut costmap = costmap(false);
        costmap.add_layer(obstacles(false, Vec::new()));
        costmap.add_layer(inflation("inflation"));
        costmap.set_footprint(Footprint::circle(0.2));
        for (index, (marks, origin)) in rounds.iter().enumerate() {
            let mut source = ObservationSource::fixed("scan", seen(*origin, marks), true, true);
            source.settings.persistence_ns = 1;
            add_source(&mut costmap, false, source);
            costmap.update(100 * index as i64, Pose2::new(2.0, 2.0, 0.0), &NoTransforms);
        }
        let in_parts = costmap.costmap().costs().to_vec();
        // A changed footprint causes a full inflation.
        costmap.set_footprint(Footprint::circle(0.2));
        costmap.update(1_000_000, Pose2::new(2.0, 2.0, 0.0), &NoTransforms);
        prop_assert_eq!(in_parts, costmap.costmap().costs().to_vec());
    }
}

fn add_source(costmap: &mut LayeredCostmap, is_voxel: bool, source: ObservationSource) {
    if is_voxel {
        costmap.find_as::<VoxelLayer>("seen").expect("it is there").add_source(source);
    } else {
        costmap.find_as::<ObstacleLayer>("seen").expect("it is there").add_source(source);
    }
}

/// Centres of the cells with a cost.
fn cells_with(costmap: &Costmap, cost: u8) -> Vec<(f64, f64)> {
    let info = costmap.info();
    let indices = (0..info.len()).filter(|index| costmap.costs()[*index] == cost);
    indices.map(|index| info.centre_of(info.cell(index))).collect()
}
