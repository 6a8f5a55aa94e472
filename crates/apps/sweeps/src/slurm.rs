//! Array jobs for SLURM, as a script.

use std::path::Path;

use periplus_os::shell_word;

/// Maximum number of tasks of an array: SLURM's default for `MaxArraySize` is 1001 with the number 0.
const MAX_TASKS: usize = 1_000;

/// Script for `sbatch`: an array whose tasks run the jobs of a plan, each task several if there are many. Jobs that have a
/// result are left out. `program` are the words that start Periplus, `options` those of the job.
#[must_use]
pub fn slurm_script(
    name: &str,
    program: &[String],
    plan: &Path,
    options: &[&str],
    job_count: usize,
) -> String {
    let tasks = job_count.clamp(1, MAX_TASKS);
    let last = tasks - 1;
    let name: String = name
        .chars()
        .map(|it| if it.is_alphanumeric() || "-_.".contains(it) { it } else { '_' })
        .collect();
    let words = program.iter().map(|word| shell_word(word)).collect::<Vec<_>>().join(" ");
    let plan = shell_word(&plan.display().to_string());
    let options: String = options.iter().map(|word| format!(" {}", shell_word(word))).collect();
    format!(
        "#!/bin/bash\n\
         #SBATCH --job-name=periplus-{name}\n\
         #SBATCH --array=0-{last}\n\
         #SBATCH --ntasks=1\n\
         #SBATCH --cpus-per-task=1\n\
         # {job_count} runs in {tasks} tasks. The folder of the plan must be visible to all nodes.\n\
         # A task that is repeated leaves out the runs that are complete: `sbatch --requeue` is safe.\n\
         exec {words} sweep-job {plan} \"${{SLURM_ARRAY_TASK_ID:?}}\" --step {tasks}{options}\n"
    )
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use super::*;

    #[test]
    fn the_script_is_an_array() {
        let program = ["/usr/bin/periplus".to_owned()];
        expect![[r#"
            #!/bin/bash
            #SBATCH --job-name=periplus-my_room
            #SBATCH --array=0-999
            #SBATCH --ntasks=1
            #SBATCH --cpus-per-task=1
            # 2500 runs in 1000 tasks. The folder of the plan must be visible to all nodes.
            # A task that is repeated leaves out the runs that are complete: `sbatch --requeue` is safe.
            exec /usr/bin/periplus sweep-job '/a b/plan.json' "${SLURM_ARRAY_TASK_ID:?}" --step 1000 --no-artifacts
        "#]]
        .assert_eq(&slurm_script("my room", &program, Path::new("/a b/plan.json"), &["--no-artifacts"], 2500));
    }
}
