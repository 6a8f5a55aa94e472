//! Any text as a robot, world or launch file of Gazebo Classic: it is refused or converted, and the same text is converted in
//! the same way.
#![no_main]

use libfuzzer_sys::fuzz_target;
use periplus_migration::{MigrationContext, migrate, migrate_launch, migrate_python_launch};
use periplus_resources::{MemoryHost, Resolver};

fuzz_target!(|text: &str| {
    let host = MemoryHost::new();
    let resolver = Resolver::new(&host, &[]);
    let context = MigrationContext::new("/fuzz.world".as_ref(), &host, &resolver);
    let new = |text: &str| migrate(text, &context).map(|migrated| migrated.text);
    assert_eq!(new(text), new(text));
    let _ = migrate_launch(text, "fuzz.launch");
    let _ = migrate_python_launch(text, "fuzz.launch.py");
});
