//! Control and state of a world.

use super::{Boolean, Header, Light, Model, Pose, Time, Vector3d};
use crate::message::{kinds, messages};

messages! {
    /// Pause, step, reset.
    WorldControl {
        1 header: Option<Header>,
        2 pause: bool,
        3 step: bool,
        4 multi_step: u32,
        5 reset: Option<WorldReset>,
        6 seed: u32,
        7 run_to_sim_time: Option<Time>,
    }
    /// Parts of the world to reset.
    WorldReset { 1 header: Option<Header>, 2 all: bool, 3 time_only: bool, 4 model_only: bool }
    /// Clock and statistics of a world.
    WorldStatistics {
        1 header: Option<Header>,
        2 sim_time: Option<Time>,
        3 pause_time: Option<Time>,
        4 real_time: Option<Time>,
        5 paused: bool,
        6 iterations: u64,
        7 model_count: i32,
        9 real_time_factor: f64,
        10 step_size: Option<Time>,
        11 stepping: bool,
    }
    /// Entity of a world.
    Entity { 1 header: Option<Header>, 2 id: u64, 3 name: String, 4 r#type: EntityKind }
    /// Entity to spawn: one of `sdf`, `sdf_filename`, `model`, `light`, `clone_name`.
    EntityFactory {
        1 header: Option<Header>,
        2 sdf: String,
        3 sdf_filename: String,
        4 model: Option<Model>,
        5 light: Option<Light>,
        6 clone_name: String,
        7 pose: Option<Pose>,
        8 name: String,
        9 allow_renaming: bool,
        10 relative_to: String,
        11 spherical_coordinates: Option<SphericalCoordinates>,
    }
    /// Several entities to spawn.
    EntityFactoryV = "EntityFactory_V" { 1 header: Option<Header>, 2 data: Vec<EntityFactory> }
    /// Geographic coordinates.
    SphericalCoordinates {
        1 header: Option<Header>,
        2 surface_model: SurfaceModel,
        3 latitude_deg: f64,
        4 longitude_deg: f64,
        5 elevation: f64,
        6 heading_deg: f64,
        7 entity: Option<Entity>,
    }
    /// Physics settings.
    Physics {
        1 header: Option<Header>,
        2 r#type: i32,
        3 solver_type: String,
        4 min_step_size: f64,
        5 precon_iters: i32,
        6 iters: i32,
        7 sor: f64,
        8 cfm: f64,
        9 erp: f64,
        10 contact_max_correcting_vel: f64,
        11 contact_surface_layer: f64,
        12 gravity: Option<Vector3d>,
        13 enable_physics: bool,
        14 real_time_factor: f64,
        15 real_time_update_rate: f64,
        16 max_step_size: f64,
        17 profile_name: String,
        18 magnetic_field: Option<Vector3d>,
    }
    /// Settings of the SDF generator.
    SdfGeneratorConfig {
        1 header: Option<Header>,
        2 global_entity_gen_config: Option<EntityGeneratorConfig>,
        3 override_entity_gen_configs: Vec<OverrideEntry>,
    }
    /// Settings of the SDF generator for entities.
    EntityGeneratorConfig = "SdfGeneratorConfig.EntityGeneratorConfig" {
        1 expand_include_tags: Option<Boolean>,
        2 save_fuel_version: Option<Boolean>,
        3 resources_use_absolute_paths: Option<Boolean>,
        4 copy_model_resources: Option<Boolean>,
    }
    /// Settings of the SDF generator for one entity.
    OverrideEntry = "SdfGeneratorConfig.OverrideEntityGenConfigsEntry" {
        1 key: String,
        2 value: Option<EntityGeneratorConfig>,
    }
    /// Settings of the GUI.
    Gui = "GUI" { 1 header: Option<Header>, 2 fullscreen: bool, 3 camera: Option<GuiCamera> }
    /// Camera of the GUI.
    GuiCamera = "GUICamera" {
        1 header: Option<Header>,
        2 name: String,
        3 view_controller: String,
        4 pose: Option<Pose>,
        5 track: Option<TrackVisual>,
        6 projection_type: String,
    }
    /// Target that a camera follows.
    TrackVisual {
        1 header: Option<Header>,
        2 name: String,
        3 id: u32,
        4 inherit_orientation: bool,
        5 min_dist: f64,
        6 max_dist: f64,
        7 r#static: bool,
        8 use_model_frame: bool,
        9 xyz: Option<Vector3d>,
        10 inherit_yaw: bool,
    }
    /// Start or end of a video recording.
    VideoRecord {
        1 header: Option<Header>,
        2 start: bool,
        3 stop: bool,
        4 format: String,
        5 save_filename: String,
    }
}

kinds! {
    /// Type of an entity.
    EntityKind {
        NONE = 0, LIGHT = 1, MODEL = 2, LINK = 3, VISUAL = 4, COLLISION = 5, SENSOR = 6, JOINT = 7,
        ACTOR = 8, WORLD = 9,
    }
    /// Model of the Earth's surface.
    SurfaceModel { EARTH_WGS84 = 0 }
}
