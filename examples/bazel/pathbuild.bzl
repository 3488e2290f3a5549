"""Programs of drawings as targets of Bazel, each with the drawings that it is made from as declared inputs."""

# Directories that pathbuild.toml names must exist where the action runs, whatever of them is an input.
_PREPARE = 'set -e; root=$PWD; pathbuild=$root/$1; cd "$2"; mkdir -p $3; shift 3; '

def _run(ctx, outputs, arguments, command, mnemonic, message):
    config = ctx.file.config
    ctx.actions.run_shell(
        inputs = ctx.files.drawings + ctx.files.data + [config],
        tools = [ctx.executable.pathbuild],
        outputs = outputs,
        arguments = [ctx.executable.pathbuild.path, config.dirname or ".", " ".join(ctx.attr.directories)] + arguments,
        command = _PREPARE + command,
        mnemonic = mnemonic,
        progress_message = message,
    )
    return [DefaultInfo(files = depset(outputs))]

def _program_impl(ctx):
    outputs = ctx.outputs.outs
    return _run(
        ctx,
        outputs,
        [ctx.attr.asked, outputs[0].dirname],
        '"$pathbuild" emit "$1" --out-dir "$root/$2" --no-cache --quiet',
        "PathbuildEmit",
        "Programs of path " + ctx.label.name,
    )

def _check_impl(ctx):
    report = ctx.actions.declare_file(ctx.label.name + ".json")
    return _run(
        ctx,
        [report],
        [report.path],
        '"$pathbuild" check --no-cache --quiet --report "json=$root/$1" && ' +
        'PATH="$(dirname "$pathbuild"):$PATH" python3 configure.py - | diff programs.bzl - || ' +
        '{ echo "errors above, or programs.bzl is not that of the drawings: ./configure.py" >&2; exit 1; }',
        "PathbuildCheck",
        "Checking all drawings",
    )

_ATTRIBUTES = {
    "config": attr.label(allow_single_file = [".toml"], mandatory = True),
    "data": attr.label_list(allow_files = True, doc = "Further files: a post, clamps, a script"),
    "directories": attr.string_list(doc = "`library` and `search` of pathbuild.toml"),
    "drawings": attr.label_list(allow_files = [".dxf", ".DXF"], doc = "The drawings that may be read"),
    "pathbuild": attr.label(executable = True, cfg = "exec", allow_single_file = True, mandatory = True),
}

pathbuild_program = rule(
    implementation = _program_impl,
    attrs = dict(
        _ATTRIBUTES,
        asked = attr.string(mandatory = True, doc = "The path or its drawing, as on the command line"),
        outs = attr.output_list(mandatory = True, doc = "Its files, all in one directory"),
    ),
    doc = "The programs of one path. An edit of a drawing that is not declared does not run it.",
)

pathbuild_check = rule(
    implementation = _check_impl,
    attrs = _ATTRIBUTES,
    doc = "Checks all drawings, each path for itself, and whether the declared inputs are those of the drawings.",
)

def pathbuild_library(name, programs, drawings, pathbuild, config = "pathbuild.toml", directories = ["components", "projects"], data = []):
    """A target for each path, :NAME for all programs, and :NAME_check.

    Args:
      name: of the target with all programs.
      programs: PROGRAMS of programs.bzl, which configure.py writes.
      drawings: all drawings.
      pathbuild: the program.
      config: pathbuild.toml.
      directories: those that it names.
      data: further files that programs are made from.
    """
    common = dict(pathbuild = pathbuild, config = config, directories = directories)
    for path, (asked, outs, read) in programs.items():
        pathbuild_program(name = path, asked = asked, outs = outs, drawings = read, data = data, **common)
    native.filegroup(name = name, srcs = programs.keys())
    pathbuild_check(name = name + "_check", drawings = drawings, data = data + ["configure.py", "programs.bzl"], **common)
