//! Files that libsdformat, liburdfdom and PyPI's xacro accept, and that must not be refused here.

mod common;

use std::path::Path;

use periplus_diagnostics::Severity;
use periplus_loader::{FileFormat, LoadedFile};
use periplus_resources::MemoryHost;

/// Reads `a.EXT` of the given text.
fn read(name: &str, text: &str) -> LoadedFile {
    let host = MemoryHost::new().with_file(Path::new("/r").join(name), text);
    common::read(&host, Path::new("/r"), Path::new(name), &[])
}

/// The codes of the errors, warnings and hints, in order.
fn codes(loaded: &LoadedFile) -> Vec<(Severity, &'static str)> {
    loaded.diagnostics.iter().map(|one| (one.severity, one.code)).collect()
}

fn check(name: &str, text: &str, expected: &[(Severity, &'static str)]) -> LoadedFile {
    let loaded = read(name, text);
    assert_eq!(codes(&loaded), expected, "{}", common::shown(&loaded));
    loaded
}

const MASS: &str = "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' \
                    izz='1'/></inertial>";

use Severity::{Hint, Warning};

#[test]
fn a_count_with_a_fraction_is_cut() {
    let lidar = |samples: &str| {
        format!(
            "<sdf version='1.9'><model name='m'><link name='l'><sensor name='s' type='lidar'>\
             <topic>scan</topic><lidar><scan><horizontal><samples>{samples}</samples>\
             <min_angle>-1</min_angle><max_angle>1</max_angle></horizontal></scan><range>\
             <min>0.1</min><max>9</max></range></lidar></sensor></link></model></sdf>"
        )
    };
    let loaded = check("a.sdf", &lidar("666.5185"), &[(Warning, "not-a-whole-number")]);
    let scene = loaded.scene.expect("a scene");
    let periplus_scene::SensorKind::Lidar(lidar_read) = &scene.models[0].links[0].sensors[0].kind
    else {
        panic!("no lidar")
    };
    assert_eq!(lidar_read.horizontal.samples, 666);
    assert!(read("a.sdf", &lidar("1e300")).diagnostics.has_errors());
}

#[test]
fn rates_below_zero_are_without_limit() {
    let text = "<sdf version='1.9'><world name='w'><physics type='ode'><real_time_factor>-1\
                </real_time_factor></physics><model name='m'><link name='l'><collision name='c'>\
                <geometry><box><size>1 1 1</size></box></geometry></collision>\
                <sensor name='s' type='contact'><update_rate>-1</update_rate><contact>\
                <collision>c</collision></contact></sensor></link></model></world></sdf>";
    let loaded = read("a.sdf", text);
    assert_eq!(loaded.diagnostics.errors(), 0, "{}", common::shown(&loaded));
    let world = &loaded.scene.expect("a scene").worlds[0];
    assert_eq!(world.physics[0].real_time_factor, 0.0);
    assert_eq!(world.models[0].links[0].sensors[0].update_rate_hz, 0.0);
}

#[test]
fn shapes_that_are_not_there_or_twice() {
    let urdf = |shape: &str| format!("<robot name='r'><link name='a'>{MASS}{shape}</link></robot>");
    let with = |geometry: &str| urdf(&format!("<collision>{geometry}</collision>"));
    check(
        "a.urdf",
        &with("<geometry><box size='1 1 1'/><sphere radius='1'/></geometry>"),
        &[(Warning, "two-shapes")],
    );
    check(
        "a.urdf",
        &with("<geometry><box size='1 1 1'/></geometry><geometry><sphere radius='1'/></geometry>"),
        &[(Warning, "repeated-element")],
    );
    check("a.urdf", &with(""), &[(Warning, "missing-element")]);
    check(
        "a.urdf",
        &urdf("<visual><origin xyz='1 0 0'/></visual>"),
        &[(Warning, "missing-element")],
    );
    let sdf =
        "<sdf version='1.9'><model name='m'><link name='l'><visual name='v'/></link></model></sdf>";
    check("a.sdf", sdf, &[(Warning, "missing-element")]);
}

#[test]
fn plugins_want_the_parameters_that_they_read() {
    let model = |plugin: &str| {
        format!(
            "<sdf version='1.9'><model name='m'><link name='l'/><link name='u'/>\
             <joint name='s' type='revolute'><parent>l</parent><child>u</child><axis><xyz>0 0 1\
             </xyz></axis></joint>{plugin}</model></sdf>"
        )
    };
    let energy = |parameter: &str| {
        model(&format!(
            "<plugin filename='gz-sim-kinetic-energy-monitor-system' \
             name='gz::sim::systems::KineticEnergyMonitor'><{parameter}>l</{parameter}></plugin>"
        ))
    };
    check("a.sdf", &energy("link_name"), &[]);
    assert!(read("a.sdf", &energy("base_link_name")).diagnostics.has_errors());
    let car = |more: &str| {
        model(&format!(
            "<plugin filename='gz-sim-ackermann-steering-system' \
             name='gz::sim::systems::AckermannSteering'>{more}<left_steering_joint>s\
             </left_steering_joint><right_steering_joint>s</right_steering_joint></plugin>"
        ))
    };
    check("a.sdf", &car("<steering_only>true</steering_only>"), &[]);
    assert!(read("a.sdf", &car("")).diagnostics.has_errors());
}

#[test]
fn a_file_of_macros_is_expanded_and_no_robot() {
    const XMLNS: &str = "xmlns:xacro='http://www.ros.org/wiki/xacro'";
    for text in [
        format!(
            "<robot {XMLNS}><xacro:macro name='m' params=''><link name='a'/></xacro:macro></robot>"
        ),
        format!("<robot name='r' {XMLNS}><xacro:property name='p' value='1'/></robot>"),
        format!(
            "<robot name='r' {XMLNS}><material name='m'><color rgba='1 0 0 1'/></material></robot>"
        ),
        format!(
            "<root {XMLNS}><xacro:macro name='m' params=''><link name='a'/></xacro:macro></root>"
        ),
    ] {
        let loaded = check("a.xacro", &text, &[(Hint, "macros-only")]);
        assert!(loaded.is_expanded && loaded.document.is_some() && loaded.scene.is_none());
    }
    let robot = format!("<robot name='r' {XMLNS}><link name='a'/></robot>");
    assert!(read("a.xacro", &robot).scene.is_some());
    // A part of a robot is expanded too, though it is not a robot by itself.
    let part = format!(
        "<robot name='r' {XMLNS}><link name='a'/><joint name='j' type='fixed'><parent link='b'/>\
         <child link='a'/></joint></robot>"
    );
    let loaded = read("a.xacro", &part);
    assert!(loaded.is_expanded && loaded.diagnostics.has_errors());
    let broken = format!("<robot name='r' {XMLNS}><link name='${{nothing}}'/></robot>");
    assert!(!read("a.xacro", &broken).is_expanded);
}

#[test]
fn a_model_and_a_frame_of_a_world_may_share_a_name() {
    for version in ["1.6", "1.7", "1.9"] {
        let text = format!(
            "<sdf version='{version}'><world name='w'><model name='ground'><static>true</static>\
             <link name='L'/></model><frame name='ground'/></world></sdf>"
        );
        let loaded = check("a.sdf", &text, &[(Warning, "duplicate-name")]);
        assert_eq!(loaded.scene.expect("a scene").worlds[0].frames[0].name, "ground_frame");
    }
}

#[test]
fn a_bare_name_includes_a_model_one_folder_up() {
    let outer = |uri: &str| {
        format!(
            "<sdf version='1.9'><model name='outer'><include merge='true'><uri>{uri}</uri></include>\
             <joint name='j' type='fixed'><parent>base</parent><child>top</child></joint>\
             <link name='top'/></model></sdf>"
        )
    };
    let config = |name: &str| {
        format!("<model><name>{name}</name><sdf version='1.9'>model.sdf</sdf></model>")
    };
    let inner = "<sdf version='1.9'><model name='inner'><link name='base'/></model></sdf>";
    for uri in ["inner", "file://inner", "model://inner"] {
        let host = MemoryHost::new()
            .with_file("/r/models/outer/model.config", config("outer"))
            .with_file("/r/models/outer/model.sdf", outer(uri))
            .with_file("/r/models/inner/model.config", config("inner"))
            .with_file("/r/models/inner/model.sdf", inner);
        let path = Path::new("models/outer/model.sdf");
        let loaded = common::read(&host, Path::new("/r"), path, &[]);
        assert_eq!(codes(&loaded), [], "{uri}: {}", common::shown(&loaded));
        // The folder of a model stands for its file.
        let loaded = common::read(&host, Path::new("/r"), Path::new("models/outer"), &[]);
        assert_eq!((codes(&loaded), loaded.language), (Vec::new(), FileFormat::Sdf));
    }
}

#[test]
fn a_branch_without_mass_is_lost_and_the_rest_is_there() {
    let robot = |masses: [&str; 2]| {
        format!(
            "<robot name='r'><link name='a'>{}<collision><geometry><sphere radius='1'/></geometry>\
             </collision></link><link name='b'>{}<collision><geometry><sphere radius='1'/>\
             </geometry></collision></link><joint name='j' type='continuous'><parent link='a'/>\
             <child link='b'/><axis xyz='0 0 1'/></joint></robot>",
            masses[0], masses[1]
        )
    };
    check("a.urdf", &robot([MASS, ""]), &[(Warning, "massless-link")]);
    // Without its root nothing of it can be simulated; as a document it is whole all the same.
    let loaded = read("a.urdf", &robot(["", MASS]));
    assert!(loaded.diagnostics.has_errors() && loaded.is_expanded);
}

#[test]
fn missing_models_of_fuel_are_told_once() {
    let include = |name: &str| {
        format!(
            "<include><uri>https://fuel.gazebosim.org/1.0/OpenRobotics/models/{name}</uri></include>"
        )
    };
    let all = [include("Cone"), include("Oak tree"), include("Cone"), include("Depot")].concat();
    let text = format!("<sdf version='1.9'><world name='w'>{all}</world></sdf>");
    let loaded = read("a.sdf", &text);
    let found: Vec<_> = loaded.diagnostics.iter().collect();
    let [one] = found[..] else { panic!("{found:?}") };
    assert_eq!(one.message, "3 models of Fuel are not on this machine and left out");
    for name in ["Cone", "Oak tree", "Depot"] {
        let command = format!(
            "gz fuel download -u \"https://fuel.gazebosim.org/1.0/OpenRobotics/models/{name}\""
        );
        assert!(one.help[0].contains(&command), "{}", one.help[0]);
    }
}
