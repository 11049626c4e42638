// SPDX-License-Identifier: MIT
#include "app/command_line.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "app/commands.h"
#include "app/picture_file.h"
#include "app/viewer/compared_settings.h"
#include "app/viewer/recording.h"
#include "app/viewer/remembered_settings.h"

namespace candela {

namespace {

CommandError usage(const std::string& line) {
    return {ExitStatus::wrong_usage, line};
}

// "1280x720"
Vec2u parse_resolution(const std::string& text) {
    unsigned width = 0, height = 0;
    char rest = 0;
    if (std::sscanf(text.c_str(), "%5ux%5u%c", &width, &height, &rest) != 2 || width == 0 || height == 0 ||
        width > 65535 || height > 65535) {
        throw usage("--resolution " + text +
                    ": is not of the form WIDTHxHEIGHT with sides from 1 to 65535, as in 1280x720");
    }
    return {width, height};
}

// "0.1,0.2,0.3"
Vec3 parse_vec3(const std::string& option, const std::string& text) {
    Vec3 out(0);
    char rest = 0;
    if (std::sscanf(text.c_str(), "%f,%f,%f%c", &out.x, &out.y, &out.z, &rest) != 3 || !is_finite(out)) {
        throw usage(option + " " + text + ": is not three numbers with commas between, as in 0,1.5,4");
    }
    return out;
}

// What a file may ask for.
void add_limit_options(CLI::App& command, LoadLimits& limits) {
    const char* group = "Limits of the file";
    command
        .add_option_function<double>(
            "--limit-memory",
            [&limits](double gib) { limits.max_memory_bytes = static_cast<uint64_t>(std::ldexp(gib, 30)); },
            "memory while loading, pixels included (16)")
        ->check(CLI::Range(1e-6, 1e6))
        ->type_name("GiB")
        ->group(group);
    command.add_option("--limit-image", limits.max_image_side, "pixels of a picture's side (16384)")
        ->check(CLI::Range(1, 1 << 20))
        ->type_name("PIXELS")
        ->group(group);
    command
        .add_option_function<double>(
            "--limit-json",
            [&limits](double mib) { limits.max_json_bytes = static_cast<uint64_t>(std::ldexp(mib, 20)); },
            "text of the document (256)")
        ->check(CLI::Range(1e-6, 4095.0))
        ->type_name("MiB")
        ->group(group);
    command.add_option("--limit-nesting", limits.max_json_nesting, "levels of its arrays and objects (128)")
        ->check(CLI::Range(1, most_json_nesting))
        ->type_name("N")
        ->group(group);
    command.add_option("--limit-count", limits.max_count, "nodes, accessors, primitives, ... of each kind (1000000)")
        ->check(CLI::Range(uint64_t{1}, uint64_t{1} << 31))
        ->type_name("N")
        ->group(group);
    command.add_option("--limit-instances", limits.max_instances, "copies of meshes that instancing places (4000000)")
        ->check(CLI::Range(uint64_t{1}, uint64_t{1} << 31))
        ->type_name("N")
        ->group(group);
}

// An option that takes one of a few words.
template <typename Value>
void take_one_of(const std::map<std::string, Value>& values, CLI::Option* option) {
    std::string words;
    for (const auto& each : values)
        words += (words.empty() ? "" : "|") + each.first;
    option->type_name(words)->transform(CLI::Validator(
        [values, words](std::string& text) {
            const auto found = values.find(text);
            if (found == values.end()) return text + " is not one of " + words;
            text = CLI::detail::value_string(found->second);
            return std::string();
        },
        ""));
}

// "0:23"
FrameRange parse_frames(const std::string& text) {
    FrameRange out;
    char rest = 0;
    if (std::sscanf(text.c_str(), "%7u:%7u%c", &out.first, &out.last, &rest) != 2 || out.first > out.last ||
        !std::isdigit(static_cast<unsigned char>(text.front()))) {
        throw usage("--frames " + text + ": is not of the form FIRST:LAST with FIRST up to LAST, as in 0:23");
    }
    return out;
}

// "albedo,normal"
std::vector<std::string> parse_list(const std::string& text) {
    std::vector<std::string> out;
    std::stringstream list(text);
    for (std::string name; std::getline(list, name, ',');)
        out.push_back(name);
    return out;
}

// Options as text, turned into values once CLI11 has read them.
struct RawRenderOptions {
    std::string resolution, eye, target, up, sky, background, aov, frames, open, compared, inspect;
};

void add_render_options(CLI::App& command, RenderOptions& options, RawRenderOptions& raw) {
    const std::map<std::string, Estimator> estimators{
        {"mis", Estimator::mis}, {"light", Estimator::light}, {"bsdf", Estimator::bsdf}};
    const std::map<std::string, SamplerKind> samplers{{"sobol", SamplerKind::sobol},
                                                      {"independent", SamplerKind::independent}};
    const std::map<std::string, bool> path_reuse{{"auto", true}, {"off", false}};
    const std::map<std::string, PixelFilter> filters{{"blackman-harris", PixelFilter::blackman_harris},
                                                     {"box", PixelFilter::box}};
    const std::map<std::string, ToneCurve> curves{{"linear", ToneCurve::linear},
                                                  {"neutral", ToneCurve::neutral},
                                                  {"aces", ToneCurve::aces},
                                                  {"agx", ToneCurve::agx}};
    const std::map<std::string, Projection> projections{{"perspective", Projection::perspective},
                                                        {"orthographic", Projection::orthographic},
                                                        {"panorama", Projection::panorama}};
    command.add_option("scene", options.scene, "a .gltf or .glb file; without it the Cornell box")->type_name("SCENE");
    command.add_option("--resolution", raw.resolution, "picture size")->type_name("WxH");
    command.add_option("--camera", options.camera, "a camera of the file by name or index")->type_name("NAME|INDEX");
    command.add_option("--eye", raw.eye, "own camera: where it stands")->type_name("X,Y,Z");
    command.add_option("--target", raw.target, "own camera: what it looks at")->type_name("X,Y,Z");
    command.add_option("--up", raw.up, "own camera: what is up (0,1,0)")->type_name("X,Y,Z");
    command.add_option("--fov", options.fov_degrees, "vertical field of view in degrees")
        ->check(CLI::Range(0.1, 179.0))
        ->type_name("DEG");
    command.add_option("--aperture", options.aperture_m, "diameter of the lens in metres (0: pinhole)")
        ->check(CLI::NonNegativeNumber)
        ->type_name("M");
    command.add_option("--focus", options.focus_m, "distance in focus in metres")
        ->check(CLI::PositiveNumber)
        ->type_name("M");
    command.add_option("--blades", options.blades, "blades of the lens's aperture, from 3 (0: round)")
        ->check(CLI::Range(0u, 64u))
        ->check([](const std::string& text) { return text == "1" || text == "2" ? "must be 0 or at least 3" : ""; })
        ->type_name("N");
    take_one_of(projections,
                command.add_option("--projection", options.projection,
                                   "perspective, orthographic or panorama: the whole sphere (the camera's own)"));
    command.add_option("--spp", options.spp, "samples per pixel")->check(CLI::Range(1u, 1u << 30))->type_name("N");
    command.add_option("--time", options.seconds, "seconds of rendering")->check(CLI::PositiveNumber)->type_name("S");
    command.add_option("--until-error", options.until_error_percent, "estimated mean relative error in percent")
        ->check(CLI::PositiveNumber)
        ->type_name("P");
    command
        .add_option("--max-depth", options.integrator.max_depth,
                    "scattering events at most; 1 = direct light, 0 = no limit")
        ->check(CLI::Range(0u, 1u << 20))
        ->type_name("N");
    take_one_of(estimators,
                command.add_option("--estimator", options.integrator.estimator, "mis, light or bsdf (mis)"));
    take_one_of(samplers, command.add_option("--sampler", options.integrator.sampler, "sobol or independent (sobol)"));
    take_one_of(filters,
                command.add_option("--filter", options.integrator.filter, "blackman-harris or box (blackman-harris)"));
    take_one_of(path_reuse, command.add_option("--path-reuse", options.integrator.reuse_paths,
                                               "auto: neighbours share paths where that pays; or off (auto)"));
    command.add_option("--clamp-indirect", options.integrator.clamp_indirect, "firefly clamp; biased (off)")
        ->check(CLI::NonNegativeNumber)
        ->type_name("V");
    command.add_option("--seed", options.integrator.seed, "of all random numbers (0)")->type_name("N");
    command.add_option("-t,--threads", options.threads, "worker threads (all cores)")
        ->check(CLI::Range(0u, 1024u))
        ->type_name("N");
    command.add_option("--hdri", options.hdri, "environment, equirectangular .hdr or .exr")->type_name("FILE");
    command.add_option("--hdri-rotation", options.hdri_rotation_degrees, "turns it counter-clockwise seen from +Y")
        ->type_name("DEG");
    command.add_option("--hdri-intensity", options.hdri_intensity, "scales it (1)")
        ->check(CLI::NonNegativeNumber)
        ->type_name("V");
    command.add_option("--sky", raw.sky, "a constant environment of that radiance")->type_name("R,G,B");
    command.add_option("--background", raw.background, "what camera rays that leave the scene see (env)")
        ->type_name("env|R,G,B|transparent");
    command.add_option("--exposure", options.tone.exposure_ev, "display only (0)")->type_name("EV");
    take_one_of(curves, command.add_option("--tonemap", options.tone.curve, "linear, neutral, aces or agx (neutral)"));
    command.add_option("--scene", options.scene_index, "which scene of the file")->type_name("N");
    command.add_option("--variant", options.variant, "which material variant of the file")->type_name("NAME");
    command.add_option("--animation", options.animation, "poses the scene by that animation of the file")
        ->type_name("NAME|INDEX");
    command.add_option("--at", options.at_seconds, "at which time of the animation (0)")
        ->check(CLI::Range(0.0, 1e9))
        ->type_name("SECONDS");
    command
        .add_option("--aov", raw.aov,
                    "extra .exr layers: albedo,normal,depth,position,uv,material,instance,samples,variance,"
                    "error,rays,bounces")
        ->type_name("LIST");
    command.add_option("--stats", options.stats_file, "JSON record of the run; - = standard output")->type_name("FILE");
    command.add_flag("--quiet", options.quiet, "no progress");
    command.add_flag("-v", options.verbose, "more detail");
    add_limit_options(command, options.limits);
}

// What only the window and its pictures show.
void add_viewer_options(CLI::App& command, RenderOptions& options, RawRenderOptions& raw) {
    const std::map<std::string, PixelMap> maps{{"error", PixelMap::error},
                                               {"samples", PixelMap::samples},
                                               {"rays", PixelMap::rays},
                                               {"bounces", PixelMap::bounces}};
    take_one_of(maps, command.add_option("--map", options.map,
                                         "beside the picture, as colours: error, samples, rays or bounces of a pixel"));
    const std::map<std::string, ReferenceMetric> metrics{{"signed", ReferenceMetric::signed_difference},
                                                         {"relmse", ReferenceMetric::relative_square},
                                                         {"flip", ReferenceMetric::flip}};
    command
        .add_option("--compare-with", raw.compared,
                    "the same view beside it with other settings: mis, light, bsdf, sobol, independent, depth=N")
        ->type_name("LIST");
    command.add_option("--reference", options.reference, "a picture to measure the distance to")->type_name("FILE");
    take_one_of(metrics, command.add_option("--metric", options.metric,
                                            "beside the picture, how far each pixel is from the reference"));
    command.add_flag("--denoise", options.denoise, "shows the picture without its noise: a preview, not the truth");
    command.add_flag("--light-groups", options.light_groups,
                     "keeps the light of each lamp apart from the start, as opening the Lights panel does");
    command
        .add_option("--frame-time", options.frame_time_ms,
                    "milliseconds to a first picture and between young ones, which begin as coarse as that takes (33)")
        ->check(CLI::Range(5.0, 1000.0))
        ->type_name("MS");
    command
        .add_option_function<double>(
            "--limit-views",
            [&options](double mib) { options.limit_views_bytes = static_cast<uint64_t>(std::ldexp(mib, 20)); },
            "for the samples of views that were left, which going back to one goes on with (512)")
        ->check(CLI::Range(0.0, 1e7))
        ->type_name("MiB");
    const std::map<std::string, Theme> themes{{"dark", Theme::dark}, {"light", Theme::light}};
    take_one_of(themes, command.add_option("--theme", options.style.theme, "colours of the panels (dark)"));
    command.add_option("--ui-scale", options.style.scale, "size of the panels, on top of the screen's own scale (1)")
        ->check(CLI::Range(smallest_ui_scale, largest_ui_scale))
        ->type_name("X");
    command.add_option("--wipe", options.wipe, "where the map begins: 0 at the left edge, 1 at the right (0.5)")
        ->check(CLI::Range(0.0f, 1.0f))
        ->type_name("X");
    command.add_option("--open", raw.open, "panels to show: panels,statistics,help")->type_name("LIST");
    command.add_option("--inspect", raw.inspect, "the panel of a pixel, and the path of its brightest sample")
        ->type_name("X,Y");
}

void finish_render_options(const RawRenderOptions& raw, RenderOptions& options) {
    if (!raw.frames.empty()) options.frames = parse_frames(raw.frames);
    if (options.frames && options.turntable)
        throw usage("--frames and --turntable exclude each other; give one of them");
    if (options.frames && options.at_seconds) throw usage("--frames and --at exclude each other; give one of them");
    if (!raw.resolution.empty()) options.resolution = parse_resolution(raw.resolution);
    if (!raw.eye.empty()) options.eye = parse_vec3("--eye", raw.eye);
    if (!raw.target.empty()) options.target = parse_vec3("--target", raw.target);
    if (!raw.up.empty()) options.up = parse_vec3("--up", raw.up);
    if (!raw.sky.empty()) options.sky = parse_vec3("--sky", raw.sky);
    if (options.sky && !options.hdri.empty()) throw usage("--sky and --hdri exclude each other; give one of them");
    if (options.target.has_value() != options.eye.has_value())
        throw usage("--eye and --target belong together; give both");
    if (raw.background == "transparent") {
        options.integrator.background = BackgroundKind::transparent;
    } else if (!raw.background.empty() && raw.background != "env") {
        options.integrator.background = BackgroundKind::color;
        options.integrator.background_color = parse_vec3("--background", raw.background);
    }
    options.aovs = parse_list(raw.aov);
    options.open = parse_list(raw.open);
    if (!raw.inspect.empty()) {
        unsigned x = 0, y = 0;
        char rest = 0;
        if (std::sscanf(raw.inspect.c_str(), "%5u,%5u%c", &x, &y, &rest) != 2)
            throw usage("--inspect " + raw.inspect + ": is not the column and row of a pixel, as in 640,360");
        options.inspect = Vec2u(x, y);
    }
    options.compared = parse_list(raw.compared);
    std::string unknown;
    compared_settings(options.integrator, options.compared, &unknown);
    if (!unknown.empty())
        throw usage("--compare-with " + unknown + ": is none of mis,light,bsdf,sobol,independent,depth=N");
    if (options.metric && options.reference.empty()) throw usage("--metric needs a --reference to measure against");
    if (!options.compared.empty() && (options.map || options.metric))
        throw usage("--compare-with stands where --map and --metric do; give one of them");
    std::error_code error;
    if (!options.reference.empty() && !std::filesystem::exists(options.reference, error))
        throw CommandError(ExitStatus::unreadable_scene, options.reference + ": there is no such file");
    for (const std::string& name : options.open) {
        if (name != "panels" && name != "statistics" && name != "help")
            throw usage("--open " + name + ": is none of panels,statistics,help");
    }
}

// What only the window and its pictures refuse.
void check_viewer_options(const RenderOptions& options) {
    if (!options.aovs.empty()) throw usage("--aov: only candela render writes more layers than the picture");
    if (!options.stats_file.empty() && options.stats_file != "-") check_output(options.stats_file);
}

// In the words of the other messages: "--scene x: is no value that it takes".
std::string words_of(const CLI::ParseError& error) {
    const std::string_view head = "Could not convert: ", between = " = ";
    std::string text = error.what();
    const size_t at = text.find(between);
    if (!text.starts_with(head) || at == std::string::npos) return text;
    return text.substr(head.size(), at - head.size()) + " " + text.substr(at + between.size()) +
           ": is no value that it takes";
}

// The words without some options that take a value, and without some that take none.
std::vector<std::string> without(const std::vector<std::string>& words, const std::vector<std::string>& options,
                                 const std::vector<std::string>& flags) {
    std::vector<std::string> out;
    for (size_t i = 0; i < words.size(); ++i) {
        const std::string name = words[i].substr(0, words[i].starts_with("--") ? words[i].find('=') : 2);
        if (std::find(flags.begin(), flags.end(), words[i]) != flags.end()) continue;
        if (std::find(options.begin(), options.end(), name) == options.end()) {
            out.push_back(words[i]);
        } else if (words[i] == name) {
            ++i;
        }
    }
    return out;
}

// What of the command line of "candela view" makes the session what it is.
std::vector<std::string> session_words(int argc, char** argv, const char* command) {
    std::vector<std::string> words(argv + 1, argv + argc);
    const auto found = std::find(words.begin(), words.end(), command);
    if (found != words.end()) words.erase(found);
    return without(words, {"--record", "--stats", "-t", "--threads", "--replay", "-o", "--output"},
                   {"--quiet", "-v", "--ui", "--no-ui", "--watch"});
}

std::string joined(int argc, char** argv) {
    std::string out = "candela";
    for (int i = 1; i < argc; ++i)
        out += std::string(" ") + argv[i];
    return out;
}

// A picture of what a recorded session led to; what stands on the command line comes after what was recorded.
ExitStatus run_replayed_screenshot(const std::string& path, const RenderOptions& asked, bool with_interface,
                                   const std::vector<std::string>& words) {
    if (!asked.scene.empty())
        throw usage("--replay " + path + ": the recording names its scene; leave " + asked.scene + " out");
    if (asked.resolution) throw usage("--replay " + path + ": the recording has its own --resolution; leave it out");
    const Recording recording = read_recording(path);
    RenderOptions options;
    try {
        std::vector<std::string> all = recording.arguments;
        all.insert(all.end(), words.begin(), words.end());
        options = parse_view_options(all);
    } catch (const CommandError& error) {
        throw CommandError(ExitStatus::unreadable_scene,
                           fmt::format("{}:{}: {}", path, recording.arguments_line, error.what()));
    }
    options.output = asked.output;
    options.stats_file = asked.stats_file;
    options.threads = asked.threads;
    options.quiet = asked.quiet;
    options.verbose = asked.verbose;
    // The picture is the same wherever it is written and whoever computes it, so its file is too.
    options.command = "candela screenshot --replay " + path;
    return run_replay(recording, options, with_interface);
}

// What was remembered is as if it stood first on the command line: so a recording has it, and an option overrules it.
RenderOptions with_remembered(const RenderOptions& asked, const RememberedSettings& remembered) {
    std::vector<std::string> words = words_of(remembered);
    words.insert(words.end(), asked.arguments.begin(), asked.arguments.end());
    RenderOptions options = parse_view_options(words);
    options.command = asked.command;
    options.arguments = std::move(words);
    options.record = asked.record;
    options.watch = asked.watch;
    options.stats_file = asked.stats_file;
    options.threads = asked.threads;
    options.quiet = asked.quiet;
    options.verbose = asked.verbose;
    return options;
}

ExitStatus dispatch(int argc, char** argv) {
    CLI::App app("candela: watch a glTF scene converge to the light that is in it");
    app.set_version_flag("--version", std::string(version_line()));
    app.require_subcommand(0, 1);

    RenderOptions render;
    RawRenderOptions raw;
    add_render_options(app, render, raw);
    CLI::App* view_command = app.add_subcommand("view", "open the window (also without a command)");
    add_render_options(*view_command, render, raw);
    for (CLI::App* command : {&app, view_command}) {
        add_viewer_options(*command, render, raw);
        command->add_flag("--watch", render.watch, "reads the scene anew when one of its files has changed");
        command->add_option("--record", render.record, "writes what is done in the window, for screenshot --replay")
            ->type_name("FILE");
    }

    bool with_interface = true;
    CLI::App* screenshot_command = app.add_subcommand("screenshot", "the viewer's own picture, drawn off-screen");
    add_render_options(*screenshot_command, render, raw);
    screenshot_command->add_option("-o,--output", render.output, "ends in .png")->required()->type_name("OUT.png");
    add_viewer_options(*screenshot_command, render, raw);
    std::string replay;
    screenshot_command->add_option("--replay", replay, "plays what view --record wrote, then takes the picture")
        ->type_name("FILE");
    screenshot_command->add_flag("--ui,!--no-ui", with_interface, "with its panels, or only the picture");

    CLI::App* render_command = app.add_subcommand("render", "render without a display");
    add_render_options(*render_command, render, raw);
    render_command->add_option("-o,--output", render.output, "ends in .png, .exr or .hdr")
        ->required()
        ->type_name("OUT");
    render_command
        ->add_option("--frames", raw.frames,
                     "pictures A to B of the animation, as OUT_0000.png and so on; picture k shows the time k / fps")
        ->type_name("A:B");
    render_command
        ->add_option("--turntable", render.turntable,
                     "N pictures of a turn around --target, or the middle of the scene, as OUT_0000.png and so on")
        ->check(CLI::Range(1u, 100000u))
        ->type_name("N");
    render_command->add_option("--fps", render.fps, "pictures a second of the animation (30)")
        ->needs("--frames")
        ->check(CLI::Range(1e-3, 1e6))
        ->type_name("N");

    InfoOptions info;
    CLI::App* info_command = app.add_subcommand("info", "what the file holds and how each extension is treated");
    info_command->add_option("scene", info.scene, "a .gltf or .glb file")->required()->type_name("SCENE");
    info_command->add_option("--scene", info.scene_index, "which scene of the file")->type_name("N");
    info_command->add_option("--variant", info.variant, "which material variant of the file")->type_name("NAME");
    info_command->add_flag("--json", info.json, "as JSON");
    info_command->add_flag("-v", info.verbose, "the whole tree, however long");
    add_limit_options(*info_command, info.limits);

    CompareOptions compare;
    CLI::App* compare_command = app.add_subcommand("compare", "how far two pictures differ");
    compare_command->add_option("a", compare.a, "the picture to judge")->required()->type_name("A");
    compare_command->add_option("b", compare.b, "the reference")->required()->type_name("B");
    compare_command->add_flag("--json", compare.json, "as JSON");
    compare_command->add_option("-o,--output", compare.output, "writes the difference picture")->type_name("OUT");
    compare_command->add_option("--max-rmse", compare.max_rmse, "exit 1 above it")->type_name("V");
    compare_command->add_option("--max-relmse", compare.max_rel_mse, "exit 1 above it")->type_name("V");
    compare_command->add_option("--max-mae", compare.max_mae, "exit 1 above it")->type_name("V");
    compare_command->add_option("--max-flip", compare.max_flip, "exit 1 above it")->type_name("V");

    ValidateOptions validate;
    CLI::App* validate_command = app.add_subcommand("validate", "the path tracer against exact answers");
    validate_command->add_flag("--json", validate.json, "as JSON");
    validate_command->add_flag("--quiet", validate.quiet, "no progress");
    validate_command->add_option("-o,--output", validate.output, "writes plots and the JSON there")->type_name("DIR");
    validate_command->add_option("--seed", validate.seed, "of all random numbers (0)")->type_name("N");
    validate_command->add_option("-t,--threads", validate.threads, "worker threads (all cores)")
        ->check(CLI::Range(0u, 1024u))
        ->type_name("N");

    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) {
            app.exit(error);
            return ExitStatus::done;
        }
        throw usage(words_of(error) + "; see candela --help");
    }
    if (*info_command) return run_info(info);
    if (*compare_command) return run_compare(compare);
    if (*validate_command) return run_validate(validate);
    render.command = joined(argc, argv);
    finish_render_options(raw, render);
    if (*render_command) return run_render(render);
    check_viewer_options(render);
    if (!replay.empty())
        return run_replayed_screenshot(replay, render, with_interface, session_words(argc, argv, "screenshot"));
    if (*screenshot_command) return run_screenshot(render, with_interface);
    render.arguments = session_words(argc, argv, *view_command ? "view" : "");
    if (!render.record.empty() && render.seconds)
        throw usage("--time and --record exclude each other: a replay counts samples; use --spp or --until-error");
    const std::string extension = extension_of(render.scene);
    std::error_code error;
    if (!*view_command && !render.scene.empty() && extension != ".gltf" && extension != ".glb" &&
        !std::filesystem::exists(render.scene, error)) {
        throw usage(render.scene + ": is neither a command nor a .gltf or .glb file; see candela --help");
    }
    std::string warning;
    const RememberedSettings remembered = read_settings(settings_path(), warning);
    if (!warning.empty() && !render.quiet) fmt::print(stderr, "candela: warning: {}\n", warning);
    return run_view(with_remembered(render, remembered), remembered);
}

}  // namespace

RenderOptions parse_view_options(const std::vector<std::string>& words) {
    CLI::App app;
    app.set_help_flag();
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    RenderOptions options;
    RawRenderOptions raw;
    add_render_options(app, options, raw);
    add_viewer_options(app, options, raw);
    try {
        app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
    } catch (const CLI::ParseError& error) {
        throw usage(words_of(error));
    }
    for (const std::string& word : words)
        options.command += (options.command.empty() ? "" : " ") + word;
    finish_render_options(raw, options);
    check_viewer_options(options);
    return options;
}

const char* version_line() {
    return "candela " CANDELA_VERSION;
}

int run_command_line(int argc, char** argv) {
    const auto report = [](const char* line, ExitStatus status) {
        // Unlike fmt::print it does not throw where standard error is full too.
        std::fprintf(stderr, "candela: %s\n", line);
        return static_cast<int>(status);
    };
    constexpr const char* output_full = "standard output: cannot be written; is the disk full?";
    try {
        const ExitStatus status = dispatch(argc, argv);
        // What was printed may still wait to be written.
        if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
            return report(output_full, ExitStatus::unwritable_output);
        return static_cast<int>(status);
    } catch (const CommandError& error) {
        return report(error.what(), error.status());
    } catch (const std::bad_alloc&) {
        return report("there is not enough memory for this", ExitStatus::internal_error);
    } catch (const std::exception& error) {
        if (std::ferror(stdout) != 0) return report(output_full, ExitStatus::unwritable_output);
        return report(error.what(), ExitStatus::internal_error);
    }
}

}  // namespace candela
