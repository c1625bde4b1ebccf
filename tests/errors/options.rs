//! Methods, tolerances and times, in the scene and on the command line.

use crate::errors::pendulum;

cases! {
    typo_simulation:
        pendulum().with("'t_end'", "'tend'") => [
            "scene.json:21:27: at simulation.tend: unknown key `tend`",
            "did you mean `t_end`?",
        ];
    out_below_file:
        pendulum().args(&["-o", "scene.json/out"]) => [
            "scene.json/out: cannot make this folder: a part of this path is a file; choose another place with -o",
        ];
    out_is_file:
        pendulum().args(&["-o", "scene.json"]) => [
            "scene.json: cannot make this folder: it is a file; choose another place with -o",
        ];
    out_proc:
        pendulum().args(&["-o", "/proc/holonom"]) => [
            "/proc/holonom: cannot make this folder: the folder that it would be in does not exist; choose another \
             place with -o",
        ];
    set_unknown:
        pendulum().args(&["--set", "ll=2"]) => [
            "at --set (`ll`): unknown parameter `ll`",
            "did you mean `l`?",
        ];
    set_no:
        pendulum().args(&["--set", "l"]) => [
            "invalid value 'l' for '--set <NAME=VALUE>': write NAME=VALUE, as in --set k1=200",
        ];
    set_abc:
        pendulum().args(&["--set", "l=abc"]) => [
            "at --set (`l`): unknown name `abc`",
            "choose one of l, m, pi",
        ];
    set_nan:
        pendulum().args(&["--set", "l=nan"]) => [
            "at --set (`l`): `NaN` is not a number",
            "expected a finite number",
        ];
    set_inf:
        pendulum().args(&["--set", "l=inf"]) => [
            "at --set (`l`): `inf` is infinite",
            "expected a finite number",
        ];
    set_empty:
        pendulum().args(&["--set", "=1"]) => [
            "invalid value '=1' for '--set <NAME=VALUE>': write NAME=VALUE, as in --set k1=200",
        ];
    rtol_0:
        pendulum().args(&["--rtol", "0"]) => [
            "invalid value '0' for '--rtol <RTOL>': it must be above zero",
        ];
    rtol_1:
        pendulum().args(&["--rtol", "-1"]) => [
            "invalid value '-1' for '--rtol <RTOL>': it must be above zero",
        ];
    rtol_nan:
        pendulum().args(&["--rtol", "nan"]) => [
            "invalid value 'nan' for '--rtol <RTOL>': `nan` is not a finite number",
        ];
    rtol_abc:
        pendulum().args(&["--rtol", "abc"]) => [
            "invalid value 'abc' for '--rtol <RTOL>': `abc` is not a finite number",
        ];
    rtol_inf:
        pendulum().args(&["--rtol", "inf"]) => [
            "invalid value 'inf' for '--rtol <RTOL>': `inf` is not a finite number",
        ];
    atol_0:
        pendulum().args(&["--atol", "0"]) => [
            "invalid value '0' for '--atol <ATOL>': it must be above zero",
        ];
    atol_1:
        pendulum().args(&["--atol", "-1"]) => [
            "invalid value '-1' for '--atol <ATOL>': it must be above zero",
        ];
    atol_nan:
        pendulum().args(&["--atol", "nan"]) => [
            "invalid value 'nan' for '--atol <ATOL>': `nan` is not a finite number",
        ];
    atol_abc:
        pendulum().args(&["--atol", "abc"]) => [
            "invalid value 'abc' for '--atol <ATOL>': `abc` is not a finite number",
        ];
    atol_inf:
        pendulum().args(&["--atol", "inf"]) => [
            "invalid value 'inf' for '--atol <ATOL>': `inf` is not a finite number",
        ];
    step_1:
        pendulum().args(&["--step", "-1"]) => [
            "invalid value '-1' for '--step <H>': it must not be below zero",
        ];
    step_nan:
        pendulum().args(&["--step", "nan"]) => [
            "invalid value 'nan' for '--step <H>': `nan` is not a finite number",
        ];
    step_abc:
        pendulum().args(&["--step", "abc"]) => [
            "invalid value 'abc' for '--step <H>': `abc` is not a finite number",
        ];
    step_inf:
        pendulum().args(&["--step", "inf"]) => [
            "invalid value 'inf' for '--step <H>': `inf` is not a finite number",
        ];
    output_step_0:
        pendulum().args(&["--output-step", "0"]) => [
            "invalid value '0' for '--output-step <DT>': it must be above zero",
        ];
    output_step_1:
        pendulum().args(&["--output-step", "-1"]) => [
            "invalid value '-1' for '--output-step <DT>': it must be above zero",
        ];
    output_step_nan:
        pendulum().args(&["--output-step", "nan"]) => [
            "invalid value 'nan' for '--output-step <DT>': `nan` is not a finite number",
        ];
    output_step_abc:
        pendulum().args(&["--output-step", "abc"]) => [
            "invalid value 'abc' for '--output-step <DT>': `abc` is not a finite number",
        ];
    output_step_inf:
        pendulum().args(&["--output-step", "inf"]) => [
            "invalid value 'inf' for '--output-step <DT>': `inf` is not a finite number",
        ];
    until_0:
        pendulum().args(&["--until", "0"]) => [
            "at --until: the end time 0 s is not after the start, 0 s",
            r#"give a later end: --until T, or "t_end" in "simulation" of the scene"#,
        ];
    until_1:
        pendulum().args(&["--until", "-1"]) => [
            "at --until: the end time -1 s is not after the start, 0 s",
            r#"give a later end: --until T, or "t_end" in "simulation" of the scene"#,
        ];
    until_nan:
        pendulum().args(&["--until", "nan"]) => [
            "invalid value 'nan' for '--until <T>': `nan` is not a finite number",
        ];
    until_inf:
        pendulum().args(&["--until", "inf"]) => [
            "invalid value 'inf' for '--until <T>': `inf` is not a finite number",
        ];
    end_before:
        pendulum().with("'t_end': 0.1", "'t_end': -1") => [
            "scene.json:21:28: at simulation.t_end: the end time -1 s is not after the start, 0 s",
            r#"give a later end: --until T, or "t_end" in "simulation" of the scene"#,
        ];
    start_after:
        pendulum().with("'t_end': 0.1", "'t_end': 0.1, 't_start': 2") => [
            "scene.json:21:28: at simulation.t_end: the end time 0.1 s is not after the start, 2 s",
            r#"give a later end: --until T, or "t_end" in "simulation" of the scene"#,
        ];
    out_step_scene:
        pendulum().with("'output_step': 0.05", "'output_step': 0") => [
            "scene.json:21:48: at simulation.output_step: the output step is 0 s",
            "give one above zero and above a ten-millionth of the time",
        ];
    out_step_tiny_scene:
        pendulum().with("'output_step': 0.05", "'output_step': 1e-12") => [
            "scene.json:21:48: at simulation.output_step: the output step is 0.000000000001 s",
            "give one above zero and above a ten-millionth of the time",
        ];
    auto_beside_integrator:
        pendulum().args(&["--method", "auto", "--integrator", "dop853"]) => [
            "the argument '--method <auto>' cannot be used with '--integrator <INTEGRATOR>'",
        ];
    auto_beside_step:
        pendulum().args(&["--method", "auto", "--step", "0.01"]) => [
            "the argument '--method <auto>' cannot be used with '--step <H>'",
        ];
    method_by_name:
        pendulum().args(&["--method", "dop853"]) => [
            "invalid value 'dop853' for '--method <auto>': it can be `auto`",
        ];
    auto_beside_projection_in_the_scene:
        pendulum().with("'t_end': 0.1", "'t_end': 0.1, 'method': 'auto', 'projection': 'none'") => [
            "scene.json:21:43: at simulation.method: `auto` chooses the projection, which is also given",
            "leave out projection or method",
        ];
    method_by_name_in_the_scene:
        pendulum().with("'t_end': 0.1", "'t_end': 0.1, 'method': 'dop853'") => [
            "scene.json:21:43: at simulation.method: `dop853` is none of the possible values",
            "auto",
        ];
    formulation_idnex1:
        pendulum().args(&["--formulation", "idnex1"]) => [
            "at --formulation: there is no formulation `idnex1`",
            "did you mean `index1`?",
        ];
    formulation_zzz:
        pendulum().args(&["--formulation", "zzz"]) => [
            "at --formulation: there is no formulation `zzz`",
            "choose one of index1, index2",
        ];
    integrator_dopri:
        pendulum().args(&["--integrator", "dopri"]) => [
            "at --integrator: there is no integrator `dopri`",
            "did you mean `dopri5`?",
        ];
    integrator_rk5:
        pendulum().args(&["--integrator", "rk5"]) => [
            "at --integrator: there is no integrator `rk5`",
            "did you mean `rk4`?",
        ];
    integrator_ode45:
        pendulum().args(&["--integrator", "ode45"]) => [
            "at --integrator: there is no integrator `ode45`",
            "did you mean `dopri5`?",
        ];
    projection_manifld:
        pendulum().args(&["--projection", "manifld"]) => [
            "at --projection: there is no projection `manifld`",
            "did you mean `manifold`?",
        ];
    projection_xx:
        pendulum().args(&["--projection", "xx"]) => [
            "at --projection: there is no projection `xx`",
            "choose one of none, position",
        ];
    formulation_baumgarte_alfa_5:
        pendulum().args(&["--formulation", "baumgarte:alfa=5"]) => [
            "at --formulation: formulation baumgarte has no option `alfa`",
            "did you mean `alpha`?",
        ];
    formulation_index1_a_5:
        pendulum().args(&["--formulation", "index1:a=5"]) => [
            "at --formulation: formulation index1 has no option `a`",
            "rank_tolerance",
        ];
    formulation_baumgarte_alpha:
        pendulum().args(&["--formulation", "baumgarte:alpha"]) => [
            "invalid value 'baumgarte:alpha' for '--formulation <FORMULATION>': `alpha` has no value",
            "write baumgarte:alpha=VALUE",
        ];
    formulation_baumgarte_alpha_x:
        pendulum().args(&["--formulation", "baumgarte:alpha=x"]) => [
            "at --formulation: baumgarte: alpha is `x`",
            "give a number, as in alpha=5",
        ];
    formulation_baumgarte_alpha_1:
        pendulum().args(&["--formulation", "baumgarte:alpha=-1"]) => [
            "at --formulation: baumgarte: alpha is -1, but cannot be negative",
            "give zero or more",
        ];
    projection_manifold_sweeps_0:
        pendulum().args(&["--projection", "manifold:sweeps=0"]) => [
            "at --projection: manifold: sweeps is 0",
            "give a whole number from 1 to 10",
        ];
    projection_manifold_sweeps_1_5:
        pendulum().args(&["--projection", "manifold:sweeps=1.5"]) => [
            "at --projection: manifold: sweeps is 1.5",
            "give a whole number from 1 to 10",
        ];
    projection_manifold_field_bth:
        pendulum().args(&["--projection", "manifold:field=bth"]) => [
            "at --projection: projection manifold has no option `field`",
            "there is only `sweeps`",
        ];
    formulation:
        pendulum().args(&["--formulation", ""]) => [
            "at --formulation: there is no formulation ``",
            "choose one of index1, index2",
        ];
    integrator_heun:
        pendulum().args(&["--integrator", "heun"]) => [
            "at --integrator: heun has no error estimate",
            r#"give a fixed step: --step H, or "step" in "simulation" of the scene"#,
        ];
    a_projection_that_costs_an_order:
        pendulum().args(&[
            "--integrator", "generalized-alpha", "--formulation", "index3", "--step", "0.01", "--projection", "full",
        ]) => [
            "at --projection: generalized_alpha with index3 loses an order with full",
            "generalized_alpha with index3 goes with projection none, position, velocity, manifold, exact",
        ];
    a_projection_that_starts_bdf_anew:
        pendulum().args(&["--integrator", "bdf", "--projection", "manifold"]) => [
            "at --projection: bdf with index1 loses an order with manifold",
            "bdf with index1 goes with projection none",
        ];
    a_step_for_a_method_that_chooses_its_own:
        pendulum().args(&["--integrator", "bdf", "--projection", "none", "--step", "0.01"]) => [
            "at --step: bdf chooses its own steps",
            "leave the step out and give --rtol and --atol",
        ];
    a_formulation_that_is_not_solved_with_derivatives:
        pendulum().args(&["--integrator", "esdirk34", "--formulation", "index3"]) => [
            "at --formulation: esdirk34 cannot integrate index3",
            "esdirk34 accepts index1, ggl, stabilized_index1, baumgarte; index3 goes with radau_iia, rattle, generalized_alpha",
        ];
    generalized_alpha_rho_inf_2:
        pendulum().args(&["--integrator", "generalized_alpha:rho_inf=2", "--formulation", "index3", "--step", "0.01"]) => [
            "generalized_alpha: rho_inf is 2",
            "give a number from 0 to 1",
        ];
    integrator_dopri5_x_1:
        pendulum().args(&["--integrator", "dopri5:x=1"]) => [
            "at --integrator: integrator dopri5 has no option `x`",
            "dopri5 takes no options",
        ];
    scene_formulation:
        pendulum().with("'t_end'", "'formulation': 'idnex1', 't_end'") => [
            "scene.json:21:34: at simulation.formulation: there is no formulation `idnex1`",
            "did you mean `index1`?",
        ];
    scene_integrator:
        pendulum().with("'t_end'", "'integrator': 'dopri', 't_end'") => [
            "scene.json:21:33: at simulation.integrator: there is no integrator `dopri`",
            "did you mean `dopri5`?",
        ];
    scene_projection:
        pendulum().with("'t_end'", "'projection': 'manifld', 't_end'") => [
            "scene.json:21:33: at simulation.projection: there is no projection `manifld`",
            "did you mean `manifold`?",
        ];
    scene_option:
        pendulum().with("'t_end'", "'formulation': {'baumgarte':{'alfa': 5}}, 't_end'") => [
            "scene.json:21:34: at simulation.formulation: formulation baumgarte has no option `alfa`",
            "did you mean `alpha`?",
        ];
    scene_option_value:
        pendulum().with("'t_end'", "'formulation': {'baumgarte':{'alpha': 'x'}}, 't_end'") => [
            "scene.json:21:34: at simulation.formulation: baumgarte: alpha is `x`",
            "give a number, as in alpha=5",
        ];
    scene_option_list:
        pendulum().with("'t_end'", "'formulation': {'baumgarte':{'alpha': [1]}}, 't_end'") => [
            "scene.json:21:34: at simulation.formulation: baumgarte: alpha is `[1]`",
            "give a number, as in alpha=5",
        ];
    scene_formulation_number:
        pendulum().with("'t_end'", "'formulation': 3, 't_end'") => [
            "scene.json:21:34: at simulation.formulation: expected the name of a method or an object with its \
             options, found 3",
            r#"write "baumgarte" or {"baumgarte": {"alpha": 5, "beta": 5}}"#,
        ];
    scene_formulation_two:
        pendulum().with("'t_end'", "'formulation': {'baumgarte':{},'index1':{}}, 't_end'") => [
            "scene.json:21:34: at simulation.formulation: expected the name of a method or an object with its \
             options, found {\"baumgarte\":{},\"index1\":{}}",
            r#"write "baumgarte" or {"baumgarte": {"alpha": 5, "beta": 5}}"#,
        ];
    scene_heun:
        pendulum().with("'t_end'", "'integrator': 'heun', 't_end'") => [
            "scene.json:21:33: at simulation.integrator: heun has no error estimate",
            r#"give a fixed step: --step H, or "step" in "simulation" of the scene"#,
        ];
    scene_step_0:
        pendulum().with("'t_end'", "'step': 0, 't_end'") => [
            "scene.json:21:27: at simulation.step: step is 0, but must be above zero",
            "give a positive number",
        ];
    scene_rtol_0:
        pendulum().with("'t_end'", "'rtol': 0, 't_end'") => [
            "scene.json:21:27: at simulation.rtol: rtol is 0, but must be above zero",
            "give a positive number",
        ];
    scene_rtol_expr:
        pendulum().with("'t_end'", "'rtol': 'q', 't_end'") => [
            r#"scene.json:21:27: at simulation.rtol: unknown name `q` at character 1 in "q""#,
            "choose one of l, m, pi",
        ];
    simulation_list:
        pendulum().with("'simulation': { 't_end': 0.1, 'output_step': 0.05 }", "'simulation': []") => [
            "scene.json:21:17: at simulation: expected an object {...}, found an empty list",
        ];
    t_end_text:
        pendulum().with("'t_end': 0.1", "'t_end': 'soon'") => [
            r#"scene.json:21:28: at simulation.t_end: unknown name `soon` at character 1 in "soon""#,
            "choose one of l, m, pi",
        ];
    figures_pdf:
        pendulum().args(&["--figures", "pdf"]) => [
            "invalid value 'pdf' for '--figures <FIGURES>'",
            "  [possible values: svg, png, none]",
        ];
}
