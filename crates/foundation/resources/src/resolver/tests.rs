use std::path::{Path, PathBuf};

use expect_test::{Expect, expect};
use periplus_diagnostics::{RenderStyle, SourceMap, render};
use proptest::prelude::*;

use crate::{EntryKind, FileReadError, Host, MemoryHost, ResolveErrorKind, Resolver};

/// A machine with empty files at the paths, and `package.xml`s that name their folder.
fn machine(paths: &[&str]) -> MemoryHost {
    paths.iter().fold(MemoryHost::new(), |host, path| {
        let folder = Path::new(path).parent().and_then(Path::file_name).unwrap_or_default();
        let content = match path.ends_with("/package.xml") {
            true => format!("<package><name>{}</name></package>", folder.display()),
            false => String::new(),
        };
        host.with_file(path, content)
    })
}

const FROM: &str = "/w/src/bot/urdf/bot.urdf";

fn resolve(host: &MemoryHost, uri: &str) -> Result<PathBuf, ResolveErrorKind> {
    Resolver::new(host, &[]).resolve(uri, Path::new(FROM)).map_err(|miss| miss.kind)
}

#[track_caller]
fn check(host: &MemoryHost, uri: &str, expected: &str) {
    assert_eq!(resolve(host, uri), Ok(PathBuf::from(expected)));
}

fn check_miss(host: &MemoryHost, uri: &str, expected: Expect) {
    let miss = Resolver::new(host, &[]).resolve(uri, Path::new(FROM)).expect_err("a miss");
    let mut sources = SourceMap::new();
    let file = sources.add("bot.urdf", format!("<mesh filename=\"{uri}\"/>"));
    let span = sources.whole(file).part(16, 16 + uri.len());
    expected.assert_eq(&render(&miss.into_diagnostic(span), &sources, RenderStyle::Plain));
}

#[test]
fn upward_itself_beside_and_below() {
    let host = machine(&[
        FROM,
        "/w/src/bot/package.xml",
        "/w/src/bot/meshes/a.stl",
        "/w/src/arm/package.xml",
        "/w/src/arm/meshes/b.stl",
        "/w/src/group/deep/hand/package.xml",
        "/w/src/group/deep/hand/c.stl",
        "/w/src/bot/models/box/model.config",
    ]);
    check(&host, "package://bot/meshes/a.stl", "/w/src/bot/meshes/a.stl");
    check(&host, "package://arm/meshes/b.stl", "/w/src/arm/meshes/b.stl");
    check(&host, "package://hand/c.stl", "/w/src/group/deep/hand/c.stl");
    check(&host, "package://hand", "/w/src/group/deep/hand");
    check(&host, "model://box", "/w/src/bot/models/box");
}

#[test]
fn packages_are_also_models_and_the_other_way_round() {
    let host = machine(&[FROM, "/w/src/bot/package.xml", "/w/src/bot/models/box/box.dae"]);
    check(&host, "model://bot/models/box/box.dae", "/w/src/bot/models/box/box.dae");
    check(&host, "package://box/box.dae", "/w/src/bot/models/box/box.dae");
}

#[test]
fn variables_in_their_order() {
    let host = machine(&[
        FROM,
        "/gz/arm/a.stl",
        "/classic/arm/a.stl",
        "/classic/arm/b.stl",
        "/ros/x/y/arm/package.xml",
        "/ros/x/y/arm/c.stl",
        "/opt/share/arm/d.stl",
        "/w/src/arm/a.stl",
        "/w/src/arm/e.stl",
        "/w/src/bot/package.xml",
    ])
    .with_variable("GZ_SIM_RESOURCE_PATH", ":/nowhere:/gz")
    .with_variable("GAZEBO_MODEL_PATH", "/classic")
    .with_variable("ROS_PACKAGE_PATH", "/ros")
    .with_variable("AMENT_PREFIX_PATH", "/opt");
    check(&host, "package://arm/a.stl", "/gz/arm/a.stl");
    check(&host, "package://arm/b.stl", "/classic/arm/b.stl");
    check(&host, "package://arm/c.stl", "/ros/x/y/arm/c.stl");
    check(&host, "package://arm/d.stl", "/opt/share/arm/d.stl");
    check(&host, "package://arm/e.stl", "/w/src/arm/e.stl");
    check(&host, "arm/b.stl", "/classic/arm/b.stl");
    let extra = [PathBuf::from("/w/src")];
    let found = Resolver::new(&host, &extra).resolve("package://arm/a.stl", Path::new(FROM));
    assert_eq!(found, Ok("/w/src/arm/a.stl".into()));
}

#[test]
fn find_prefers_the_folder_that_says_it_is_the_package() {
    let host = machine(&[FROM, "/w/src/bot/package.xml", "/w/src/bot/bot/x.py"]);
    let resolver = Resolver::new(&host, &[]);
    assert_eq!(resolver.find_package("bot", Path::new(FROM)), Ok("/w/src/bot".into()));
    let host = machine(&[FROM, "/gz/box/readme", "/w/src/bot/package.xml"])
        .with_file("/w/src/bot/models/box/model.sdf", "")
        .with_variable("GZ_SIM_RESOURCE_PATH", "/gz");
    let resolver = Resolver::new(&host, &[]);
    assert_eq!(resolver.find_model("box", Path::new(FROM)), Ok("/w/src/bot/models/box".into()));
    assert_eq!(resolver.find_package("box", Path::new(FROM)), Ok("/gz/box".into()));
}

#[test]
fn exported_model_paths_are_searched() {
    let manifest = "<package><name>props</name><export>
        <gazebo_ros gazebo_model_path='${prefix}/things'/></export></package>";
    let host = machine(&[FROM, "/w/src/bot/package.xml", "/w/src/props/things/cup/model.sdf"])
        .with_file("/w/src/props/package.xml", manifest);
    check(&host, "model://cup", "/w/src/props/things/cup");
    let hostile = manifest.replace("${prefix}/things", "/");
    let host = machine(&[FROM, "/w/src/bot/package.xml", "/etc/passwd"])
        .with_file("/w/src/props/package.xml", hostile);
    assert_eq!(resolve(&host, "model://etc/passwd"), Err(ResolveErrorKind::Outside));
}

#[test]
fn paths_relative_absolute_and_loose() {
    let host = machine(&[
        FROM,
        "/w/src/bot/package.xml",
        "/w/src/bot/meshes/a.stl",
        "/w/src/bot/urdf/b c.stl",
        "/classic/media/materials/scripts/gazebo.material",
    ])
    .with_variable("GAZEBO_RESOURCE_PATH", "/classic");
    check(&host, "../meshes/a.stl", "/w/src/bot/meshes/a.stl");
    check(&host, "b%20c.stl", "/w/src/bot/urdf/b c.stl");
    check(&host, "/w/src/bot/meshes/a.stl", "/w/src/bot/meshes/a.stl");
    check(&host, "file:///w/src/bot/meshes/a.stl", "/w/src/bot/meshes/a.stl");
    check(&host, "file://meshes/a.stl", "/w/src/bot/meshes/a.stl");
    check(
        &host,
        "file://media/materials/scripts/gazebo.material",
        "/classic/media/materials/scripts/gazebo.material",
    );
}

#[test]
fn the_fuel_cache() {
    let host = machine(&[FROM, "/home/ada/.gz/fuel/fuel.gazebosim.org/ada/models/cup/2/a.dae"])
        .with_variable("HOME", "/home/ada");
    let cup = "/home/ada/.gz/fuel/fuel.gazebosim.org/ada/models/cup/2";
    check(&host, "https://fuel.gazebosim.org/1.0/Ada/models/Cup", cup);
    let file = "https://fuel.gazebosim.org/1.0/Ada/models/Cup/tip/files/a.dae";
    check(&host, file, &format!("{cup}/a.dae"));
    check_miss(
        &host,
        "https://fuel.gazebosim.org/1.0/Ada/models/Mug",
        expect![[r#"
            error[missing-resource]: `https://fuel.gazebosim.org/1.0/Ada/models/Mug` cannot be found: the model is not in the Fuel cache
             --> bot.urdf:1:17
              |
            1 | <mesh filename="https://fuel.gazebosim.org/1.0/Ada/models/Mug"/>
              |                 ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
              |
              = note: tried
                        /home/ada/.gz/fuel/fuel.gazebosim.org/ada/models/mug/*
                        /home/ada/.gz/fuel/fuel.gazebosim.org/Ada/models/Mug/*
                        /home/ada/.gz/fuel/fuel.ignitionrobotics.org/ada/models/mug/*
                        /home/ada/.gz/fuel/fuel.ignitionrobotics.org/Ada/models/Mug/*
                        /home/ada/.ignition/fuel/fuel.gazebosim.org/ada/models/mug/*
                        /home/ada/.ignition/fuel/fuel.gazebosim.org/Ada/models/Mug/*
                        /home/ada/.ignition/fuel/fuel.ignitionrobotics.org/ada/models/mug/*
                        /home/ada/.ignition/fuel/fuel.ignitionrobotics.org/Ada/models/Mug/*
              = help: fetch it once: `gz fuel download -u https://fuel.gazebosim.org/1.0/Ada/models/Mug`
        "#]],
    );
}

#[test]
fn a_package_that_is_not_there() {
    let host = machine(&[FROM, "/w/src/bot/package.xml", "/w/src/arm/package.xml"])
        .with_variable("AMENT_PREFIX_PATH", "/opt/ros");
    check_miss(
        &host,
        "package://amr/a.stl",
        expect![[r#"
            error[missing-resource]: `package://amr/a.stl` cannot be found: there is no package `amr`
             --> bot.urdf:1:17
              |
            1 | <mesh filename="package://amr/a.stl"/>
              |                 ^^^^^^^^^^^^^^^^^^^
              |
              = note: tried
                        /opt/ros/share/amr/a.stl
                        /w/src/bot/urdf/amr/a.stl
                        /w/src/bot/urdf/models/amr/a.stl
                        /w/src/bot/urdf/src/amr/a.stl
                        /w/src/bot/urdf/**/amr/a.stl
                        /w/src/bot/amr/a.stl
                        /w/src/bot/models/amr/a.stl
                        /w/src/bot/src/amr/a.stl
                        /w/src/bot/**/amr/a.stl
                        /w/src/amr/a.stl
                        /w/src/models/amr/a.stl
                        /w/src/src/amr/a.stl
                        /w/src/**/amr/a.stl
                        /w/amr/a.stl
                        /w/models/amr/a.stl
              = help: did you mean `package://arm`?
              = help: name the folder that contains `amr`: `--resource-path FOLDER`
        "#]],
    );
}

#[test]
fn a_file_that_is_not_in_the_package() {
    let host = machine(&[FROM, "/w/src/bot/package.xml", "/w/src/bot/meshes/Base.STL"]);
    check_miss(
        &host,
        "package://bot/meshes/base.stl",
        expect![[r#"
            error[missing-resource]: `package://bot/meshes/base.stl` cannot be found: `bot` is /w/src/bot, but has no `meshes/base.stl`
             --> bot.urdf:1:17
              |
            1 | <mesh filename="package://bot/meshes/base.stl"/>
              |                 ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
              |
              = note: tried
                        /w/src/bot/urdf/bot/meshes/base.stl
                        /w/src/bot/urdf/models/bot/meshes/base.stl
                        /w/src/bot/urdf/src/bot/meshes/base.stl
                        /w/src/bot/urdf/**/bot/meshes/base.stl
                        /w/src/bot/bot/meshes/base.stl
                        /w/src/bot/models/bot/meshes/base.stl
                        /w/src/bot/src/bot/meshes/base.stl
                        /w/src/bot/meshes/base.stl
                        /w/src/bot/**/bot/meshes/base.stl
                        /w/src/models/bot/meshes/base.stl
                        /w/src/src/bot/meshes/base.stl
                        /w/bot/meshes/base.stl
                        /w/models/bot/meshes/base.stl
              = help: did you mean `meshes/Base.STL`?
        "#]],
    );
}

#[test]
fn nothing_outside_the_project_is_named() {
    let host = machine(&[
        FROM,
        "/w/src/bot/package.xml",
        "/w/src/arm/b.stl",
        "/w/secret",
        "/etc/passwd",
        "/home/x/.ssh/id",
    ])
    .with_link("/w/src/bot/meshes", "/home/x/.ssh")
    .with_link("/w/src/evil", "/etc");
    check(&host, "package://bot/../arm/b.stl", "/w/src/arm/b.stl");
    for uri in [
        "package://bot/../../secret",
        "package://bot/../../../etc/passwd",
        "package://bot/%2e%2e/../../etc/passwd",
        "package://bot/%2Fetc/passwd",
        "package://bot/meshes/id",
        "model://evil/passwd",
        "model://evil",
        "/etc/passwd",
        "file:///etc/passwd",
        "../../../../etc/passwd",
        "file://../../../../etc/passwd",
    ] {
        assert_eq!(resolve(&host, uri), Err(ResolveErrorKind::Outside), "{uri}");
    }
    check_miss(
        &host,
        "file:///etc/passwd",
        expect![[r#"
            error[resource-outside]: `file:///etc/passwd` may not be used: it leaves the resource paths
             --> bot.urdf:1:17
              |
            1 | <mesh filename="file:///etc/passwd"/>
              |                 ^^^^^^^^^^^^^^^^^^
              |
              = note: tried
                        /etc/passwd
              = help: if you trust this file, allow the folder: `--resource-path /etc`
        "#]],
    );
    let extra = [PathBuf::from("/etc")];
    let allowed = Resolver::new(&host, &extra).resolve("/etc/passwd", Path::new(FROM));
    assert_eq!(allowed, Ok("/etc/passwd".into()));
}

#[test]
fn a_package_installed_as_links_into_its_sources() {
    let host = machine(&[
        FROM,
        "/home/ada/src/arm/package.xml",
        "/home/ada/src/arm/a.stl",
        "/home/ada/src/arm/model.sdf",
        "/w/install/share/arm/other.txt",
    ])
    .with_link("/w/install/share/arm/package.xml", "/home/ada/src/arm/package.xml")
    .with_link("/w/install/share/arm/a.stl", "/home/ada/src/arm/a.stl")
    .with_link("/w/install/share/arm/model.sdf", "/home/ada/src/arm/model.sdf")
    .with_variable("AMENT_PREFIX_PATH", "/w/install");
    check(&host, "package://arm/a.stl", "/home/ada/src/arm/a.stl");
    check(&host, "file:///w/install/share/arm/a.stl", "/home/ada/src/arm/a.stl");
    let resolver = Resolver::new(&host, &[]);
    let folder = resolver.find_model("arm", Path::new(FROM)).unwrap();
    assert_eq!(folder, Path::new("/w/install/share/arm"));
    assert_eq!(resolver.model_file(&folder), Ok("/home/ada/src/arm/model.sdf".into()));
}

#[test]
fn a_package_without_a_manifest_is_known_by_its_folder() {
    let from = Path::new("/home/ada/x/bot/urdf/parts/wheel.xacro");
    let host = machine(&["/home/ada/x/bot/meshes/a.stl", "/home/ada/.ssh/id"])
        .with_file(from, "")
        .with_variable("HOME", "/home/ada");
    let resolver = Resolver::new(&host, &[]);
    let resolve = |uri| resolver.resolve(uri, from).map_err(|miss| miss.kind);
    let mesh = PathBuf::from("/home/ada/x/bot/meshes/a.stl");
    assert_eq!(resolve("package://bot/meshes/a.stl"), Ok(mesh));
    assert_eq!(resolve("package://ada/.ssh/id"), Err(ResolveErrorKind::Outside));
    assert_eq!(resolve("package://home/ada/.ssh/id"), Err(ResolveErrorKind::Outside));
}

#[test]
fn a_package_found_by_name_may_be_named_by_path_afterwards() {
    let host = machine(&[FROM, "/w/src/.git/HEAD", "/opt/x/arm/package.xml", "/opt/x/arm/a.stl"])
        .with_link("/w/src/arm", "/opt/x/arm");
    let resolver = Resolver::new(&host, &[]);
    let mesh = || resolver.resolve("/opt/x/arm/a.stl", Path::new(FROM)).map_err(|miss| miss.kind);
    assert_eq!(mesh(), Err(ResolveErrorKind::Outside));
    assert_eq!(resolver.find_package("arm", Path::new(FROM)), Ok("/opt/x/arm".into()));
    assert_eq!(mesh(), Ok("/opt/x/arm/a.stl".into()));
}

fn check_model(files: &[(&str, &str)], expected: Result<&str, &str>) {
    let host = files.iter().fold(MemoryHost::new(), |host, (name, content)| {
        host.with_file(format!("/m/cup/{name}"), *content)
    });
    let found = Resolver::new(&host, &[]).model_file(Path::new("/m/cup"));
    let found = found.map_err(|miss| miss.reason);
    assert_eq!(found, expected.map(PathBuf::from).map_err(str::to_owned));
}

#[test]
fn the_newest_description_that_is_read() {
    let config = "<model><sdf version='1.9'>a.sdf</sdf><sdf version='1.10'>b.sdf</sdf>
        <sdf version='1.13'>c.sdf</sdf></model>";
    let files = [("model.config", config), ("a.sdf", ""), ("b.sdf", ""), ("c.sdf", "")];
    check_model(&files, Ok("/m/cup/b.sdf"));
    check_model(&[("model.sdf", ""), ("cup.sdf", "")], Ok("/m/cup/model.sdf"));
    check_model(&[("cup.urdf", "")], Ok("/m/cup/cup.urdf"));
    check_model(&[("model.config", config), ("model.sdf", "")], Ok("/m/cup/model.sdf"));
    check_model(&[("readme", "")], Err("no file in it is a model"));
    check_model(
        &[("model.config", "<model><sdf version='1.13'>c.sdf</sdf></model>"), ("c.sdf", "")],
        Err("its model.config offers SDF 1.13 and nothing older; up to 1.12 is read"),
    );
    let climbing = "<model><sdf version='1.9'>../../etc/passwd</sdf></model>";
    let host =
        MemoryHost::new().with_file("/etc/passwd", "").with_file("/m/c/model.config", climbing);
    let found = Resolver::new(&host, &[]).model_file(Path::new("/m/c"));
    assert_eq!(found.map_err(|miss| miss.kind), Err(ResolveErrorKind::Outside));
}

/// Counts the questions.
struct Counting<'a>(&'a MemoryHost, std::cell::Cell<usize>);

impl Counting<'_> {
    fn count(&self) -> &MemoryHost {
        self.1.set(self.1.get() + 1);
        self.0
    }
}

impl Host for Counting<'_> {
    fn read(&self, path: &Path) -> Result<Vec<u8>, FileReadError> {
        self.count().read(path)
    }
    fn kind(&self, path: &Path) -> Option<EntryKind> {
        self.count().kind(path)
    }
    fn list(&self, folder: &Path) -> Vec<String> {
        self.count().list(folder)
    }
    fn canonical(&self, path: &Path) -> Option<PathBuf> {
        self.count().canonical(path)
    }
    fn variable(&self, name: &str) -> Option<String> {
        self.count().variable(name)
    }
}

#[test]
fn the_same_uri_is_looked_up_once() {
    let host = machine(&[FROM, "/w/src/bot/package.xml", "/w/src/bot/a.stl"]);
    let counting = Counting(&host, std::cell::Cell::default());
    let resolver = Resolver::new(&counting, &[]);
    for uri in ["package://bot/a.stl", "package://nobody/a.stl", "../a.stl"] {
        let first = resolver.resolve(uri, Path::new(FROM));
        let asked = counting.1.get();
        for _ in 0..10_000 {
            assert_eq!(resolver.resolve(uri, Path::new(FROM)), first);
        }
        assert_eq!(counting.1.get(), asked, "{uri}");
    }
}

#[test]
fn a_million_wrong_names_end() {
    let host = machine(&[FROM]);
    let counting = Counting(&host, std::cell::Cell::default());
    let resolver = Resolver::new(&counting, &[]);
    for index in 0..3_000 {
        assert!(resolver.resolve(&format!("package://bot{index}/a"), Path::new(FROM)).is_err());
    }
    let asked = counting.1.get();
    let miss = resolver.resolve("package://one_more/a", Path::new(FROM)).expect_err("a miss");
    assert_eq!(counting.1.get(), asked);
    assert_eq!(
        miss.reason,
        "2000 other URIs of this file could not be resolved, so it was not searched"
    );
}

#[test]
fn a_file_named_without_a_folder_is_in_the_working_folder() {
    let host = machine(&["/bot.urdf", "/a.stl"]);
    let found = Resolver::new(&host, &[]).resolve("a.stl", Path::new("bot.urdf"));
    assert_eq!(found, Ok("/a.stl".into()));
    let _ = Resolver::new(&host, &[]).resolve("a.stl", Path::new(""));
}

proptest! {
    #[test]
    fn no_uri_leads_out(uri in "(package://|model://|file://|file:///|/|)(bot|evil|etc|\\.\\.|%2e%2e|%2F|/|x|\0|https://fuel.gazebosim.org/){0,8}(passwd|a.stl|)") {
        let host = machine(&[FROM, "/w/src/bot/package.xml", "/w/src/bot/a.stl", "/etc/passwd"])
            .with_variable("HOME", "/w/home")
            .with_link("/w/src/bot/evil", "/etc");
        if let Ok(found) = resolve(&host, &uri) {
            prop_assert!(found.starts_with("/w/src"), "{}", found.display());
        }
    }

    #[test]
    fn any_text_gives_an_answer(uri in "\\PC*", from in "\\PC*") {
        let host = machine(&[FROM]);
        let _ = Resolver::new(&host, &[]).resolve(&uri, Path::new(&from));
        let _ = Resolver::new(&host, &[]).find_package(&uri, Path::new(&from));
    }
}

#[test]
fn clones_of_a_workspace_see_each_other() {
    let host = machine(&[
        "/home/ada/ws/src/robot/.git/HEAD",
        "/home/ada/ws/src/robot/bot/package.xml",
        "/home/ada/ws/src/robot/bot/launch/bot.launch.py",
        "/home/ada/ws/src/vendor/worlds/.git/HEAD",
        "/home/ada/ws/src/vendor/worlds/stack/office/package.xml",
        "/home/ada/ws/src/vendor/worlds/stack/office/office.sdf",
        "/home/ada/other/arm/package.xml",
    ])
    .with_variable("HOME", "/home/ada");
    let resolver = Resolver::new(&host, &[]);
    let from = Path::new("/home/ada/ws/src/robot/bot/launch/bot.launch.py");
    let office = resolver.resolve("package://office/office.sdf", from);
    assert_eq!(office, Ok("/home/ada/ws/src/vendor/worlds/stack/office/office.sdf".into()));
    assert!(resolver.find_package("arm", from).is_err(), "no other folder of somebody's home");
    let names: Vec<String> = resolver.packages(from).into_keys().collect();
    assert_eq!(names, ["bot", "office"]);
}

#[test]
fn a_workspace_is_also_one_where_something_was_built() {
    let host = machine(&[
        "/home/ada/ws/robot/.git/HEAD",
        "/home/ada/ws/robot/bot/package.xml",
        "/home/ada/ws/robot/bot/a.urdf",
        "/home/ada/ws/worlds/office/package.xml",
        "/home/ada/ws/install/setup.bash",
        "/home/ada/ws/log/latest",
    ]);
    let from = Path::new("/home/ada/ws/robot/bot/a.urdf");
    let office = Resolver::new(&host, &[]).find_package("office", from);
    assert_eq!(office, Ok("/home/ada/ws/worlds/office".into()));
}

#[test]
fn a_repository_named_like_a_package_in_it_is_not_that_package() {
    let host = machine(&[
        "/w/src/bot/.git/HEAD",
        "/w/src/bot/README.md",
        "/w/src/bot/bot/package.xml",
        "/w/src/bot/bot/launch/a.launch",
    ]);
    let resolver = Resolver::new(&host, &["/w/src".into()]);
    let from = Path::new("/elsewhere/a.launch");
    assert_eq!(resolver.find_package("bot", from), Ok("/w/src/bot/bot".into()));
}
