// SPDX-License-Identifier: Apache-2.0
#include "baker/cli/config_file.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <numeric>

#include "baker/cli/fix_options.h"
#include "baker/cli/role_options.h"
#include "runtime/base/error.h"

namespace surimi {
namespace {

/// Where in which file, for messages.
struct Place {
    std::string file;
    [[noreturn]] void fail(const toml::node& node, const std::string& what) const {
        throw Error(ErrorKind::usage, fmt::format("{}:{}: {}", file, node.source().begin.line, what));
    }
};

void check_keys(const toml::table& table, const std::vector<std::string>& known, const Place& place) {
    for (const auto& [key, node] : table) {
        const std::string name(key.str());
        if (std::find(known.begin(), known.end(), name) == known.end())
            place.fail(node, fmt::format("unknown key \"{}\"; did you mean \"{}\"?", name, nearest(name, known)));
    }
}

template <class T>
T value_of(const toml::node& node, const std::string& key, const Place& place) {
    const auto value = node.value<T>();
    if (!value) place.fail(node, fmt::format("\"{}\" has a value of the wrong type", key));
    return *value;
}

Vec3 vector_of(const toml::node& node, const std::string& key, const Place& place) {
    const toml::array* array = node.as_array();
    if (!array || array->size() != 3) place.fail(node, fmt::format("\"{}\" must be three numbers", key));
    Vec3 v;
    for (int i = 0; i < 3; ++i) v[i] = value_of<double>(*array->get(static_cast<size_t>(i)), key, place);
    if (!is_finite(v)) place.fail(node, fmt::format("\"{}\" must be finite", key));
    return v;
}

MonitorRectangles::Rectangle rectangle_of(const toml::table& table, const Place& place) {
    MonitorRectangles::Rectangle rectangle;
    for (const auto& [key, target] : {std::pair{"center", &rectangle.center}, std::pair{"half_u", &rectangle.half_u},
                                      std::pair{"half_v", &rectangle.half_v}}) {
        const toml::node* node = table.get(key);
        if (!node) place.fail(table, fmt::format("a rectangle needs \"{}\" = [x, y, z]", key));
        *target = vector_of(*node, key, place);
    }
    if (!(glm::length(glm::cross(rectangle.half_u, rectangle.half_v)) > 0))
        place.fail(table, "half_u and half_v span no area");
    return rectangle;
}

void read_monitor(const toml::table& table, const Place& place, MonitorRequest& request) {
    check_keys(table, {"node", "name", "channel", "radiance", "rectangles", "center", "half_u", "half_v"}, place);
    std::optional<int> channel;
    if (const toml::node* node = table.get("channel"))
        channel = parse_monitor_selector("x=" + value_of<std::string>(*node, "channel", place)).channel;
    if (const toml::node* node = table.get("node")) {
        request.config_nodes.push_back({value_of<std::string>(*node, "node", place), channel});
        return;
    }
    MonitorRectangles monitor;
    monitor.channel = channel;
    monitor.name = fmt::format("monitor_{}", request.config_rectangles.size() + 1);
    if (const toml::node* node = table.get("name")) monitor.name = value_of<std::string>(*node, "name", place);
    if (const toml::node* node = table.get("radiance")) monitor.radiance = vector_of(*node, "radiance", place);
    if (const toml::node* node = table.get("rectangles")) {
        const toml::array* array = node->as_array();
        if (!array || array->empty()) place.fail(*node, "\"rectangles\" must be a list of tables");
        for (const toml::node& item : *array) {
            if (!item.is_table()) place.fail(item, "\"rectangles\" must be a list of tables");
            check_keys(*item.as_table(), {"center", "half_u", "half_v"}, place);
            monitor.rectangles.push_back(rectangle_of(*item.as_table(), place));
        }
    } else {
        monitor.rectangles.push_back(rectangle_of(table, place));
    }
    request.config_rectangles.push_back(monitor);
}

TexelScale texel_scale_of(const toml::table& table, const Place& place) {
    check_keys(table, {"node", "material", "scale"}, place);
    TexelScale wish;
    if (const toml::node* node = table.get("node")) wish.node = value_of<std::string>(*node, "node", place);
    if (const toml::node* node = table.get("material")) wish.material = value_of<std::string>(*node, "material", place);
    if (wish.node.empty() && wish.material.empty())
        place.fail(table, "a texel_scale needs \"node\" or \"material\", the name or a pattern");
    const toml::node* scale = table.get("scale");
    if (!scale) place.fail(table, "a texel_scale needs \"scale\", texels a metre over the usual");
    wish.scale = value_of<double>(*scale, "scale", place);
    if (!(wish.scale >= least_texel_scale && wish.scale <= largest_texel_scale))
        place.fail(*scale, "\"scale\" must be from 0.001 to 1000");
    return wish;
}

ObjectRoles object_of(const toml::table& table, const Place& place) {
    check_keys(table, {"node", "casts", "receives", "two_sided", "exclude"}, place);
    ObjectRoles object;
    const toml::node* node = table.get("node");
    if (!node) place.fail(table, "an object needs \"node\", the name or a pattern");
    object.node = value_of<std::string>(*node, "node", place);
    if (table.size() < 2) place.fail(table, "an object needs one of casts, receives, two_sided and exclude");
    visit_marks(object.roles, [&](const char* key, std::optional<bool>& mark) {
        if (const toml::node* value = table.get(key)) mark = value_of<bool>(*value, key, place);
    });
    return object;
}

void read_size(const toml::node& node, const Place& place, UnwrapSettings& settings) {
    if (const toml::array* array = node.as_array()) {
        if (array->size() != 2) place.fail(node, "\"size\" must be a number or [width, height]");
        settings.width = value_of<int>(*array->get(0), "size", place);
        settings.height = value_of<int>(*array->get(1), "size", place);
    } else {
        settings.width = settings.height = value_of<int>(node, "size", place);
    }
}

std::vector<std::string> strings_of(const toml::node& node, const std::string& key, const Place& place) {
    const toml::array* array = node.as_array();
    if (!array) place.fail(node, fmt::format("\"{}\" must be an array of names", key));
    std::vector<std::string> strings;
    for (const toml::node& item : *array) strings.push_back(value_of<std::string>(item, key, place));
    return strings;
}

std::vector<const toml::table*> tables_of(const toml::node& node, const std::string& key, const Place& place) {
    std::vector<const toml::table*> tables;
    const toml::array* array = node.as_array();
    if (!array) place.fail(node, fmt::format("\"{0}\" is written as [[{0}]]", key));
    for (const toml::node& item : *array) {
        if (!item.is_table()) place.fail(item, fmt::format("\"{0}\" is written as [[{0}]]", key));
        tables.push_back(item.as_table());
    }
    return tables;
}

void read_unwrap_key(const std::string& key, const toml::node& node, const Place& place, UnwrapSettings& settings) {
    if (key == "size") read_size(node, place, settings);
    if (key == "density") settings.texels_per_metre = value_of<double>(node, key, place);
    if (key == "gutter") settings.gutter = value_of<int>(node, key, place);
    if (key == "uniform") settings.is_uniform = value_of<bool>(node, key, place);
    if (key == "mips") settings.mips = value_of<int>(node, key, place);
    if (key == "atlases") settings.atlases = value_of<int>(node, key, place);
    if (key == "stretch") settings.stretch = value_of<double>(node, key, place);
    if (key == "uv") settings.uv = parse_uv_source(value_of<std::string>(node, key, place), place.file);
    if (key == "uv-quality") settings.quality = parse_uv_quality(value_of<std::string>(node, key, place), place.file);
}

void read_gather_key(const std::string& key, const toml::node& node, const Place& place, GatherWishes& wishes) {
    if (key == "error") wishes.error = value_of<double>(node, key, place);
    if (key == "exact") wishes.is_exact = value_of<bool>(node, key, place);
    if (key == "quality") wishes.quality = value_of<std::string>(node, key, place);
    if (key == "time") wishes.seconds = value_of<double>(node, key, place);
    if (key == "method") wishes.method = value_of<std::string>(node, key, place);
    if (key == "samples") wishes.samples = value_of<int>(node, key, place);
    if (key == "audit") wishes.audit = value_of<int>(node, key, place);
    if (key == "strict") wishes.is_strict = value_of<bool>(node, key, place);
    if (key == "supersample") wishes.supersample = value_of<int>(node, key, place);
    if (key == "fit") wishes.fit = value_of<std::string>(node, key, place);
    if (key == "memory") wishes.memory = value_of<int>(node, key, place);
    if (key == "seed") wishes.seed = static_cast<uint64_t>(value_of<int64_t>(node, key, place));
}

void read_key(const std::string& key, const toml::node& node, const Place& place, Config& config) {
    read_unwrap_key(key, node, place, config.bake.unwrap);
    if (key == "threads") config.threads = value_of<int>(node, key, place);
    if (key == "monitor")
        for (const toml::table* item : tables_of(node, key, place)) read_monitor(*item, place, config.monitors);
    if (key == "without") do_without(strings_of(node, key, place), place.file, config.bake);
    if (key == "glass") config.roles.glass = parse_glass(value_of<std::string>(node, key, place), place.file);
    if (key == "object")
        for (const toml::table* item : tables_of(node, key, place))
            config.roles.objects.push_back(object_of(*item, place));
    if (key == "texel_scale")
        for (const toml::table* item : tables_of(node, key, place))
            config.bake.unwrap.texel_scales.push_back(texel_scale_of(*item, place));
}

}  // namespace

void read_config_file(const std::filesystem::path& path, Config& config) {
    const Place place{path.string()};
    toml::table table;
    try {
        table = toml::parse_file(path.string());
    } catch (const toml::parse_error& error) {
        throw Error(ErrorKind::usage, fmt::format("{}:{}: {}", path.string(), error.source().begin.line,
                                                  std::string(error.description())));
    }
    check_keys(table, {"size",        "density", "gutter", "mips",   "atlases", "stretch", "uv",
                       "uv-quality",  "uniform", "error",  "exact",  "quality", "time",    "method",
                       "samples",     "audit",   "strict", "seed",   "threads", "monitor", "texel_scale",
                       "supersample", "memory",  "glass",  "object", "without", "fit"},
               place);
    if (table.contains("size") && table.contains("density"))
        place.fail(*table.get("density"), "\"size\" and \"density\" exclude each other: one follows from the other");
    GatherWishes wishes;
    for (const auto& [key, node] : table) {
        read_key(std::string(key.str()), node, place, config);
        read_gather_key(std::string(key.str()), node, place, wishes);
    }
    apply(wishes, path.string(), config);
    check_ranges(config, path.string());
}

void check_ranges(const Config& config, const std::string& source) {
    const auto require = [&](bool holds, const std::string& what) {
        if (!holds) throw Error(ErrorKind::usage, source + ": " + what);
    };
    const UnwrapSettings& unwrap = config.bake.unwrap;
    require(std::min(unwrap.width, unwrap.height) >= 16 && std::max(unwrap.width, unwrap.height) <= 16384,
            "size must be from 16 to 16384 texels");
    require(std::isfinite(unwrap.texels_per_metre) && unwrap.texels_per_metre >= 0, "density must be positive");
    require(unwrap.gutter >= 1 && unwrap.gutter <= 64, "gutter must be from 1 to 64 texels");
    require(unwrap.mips >= 0 && unwrap.mips <= 8, "mips must be from 0 to 8");
    require(unwrap.atlases >= 1 && unwrap.atlases <= 16, "atlases must be from 1 to 16");
    require(unwrap.stretch > 1 && unwrap.stretch <= 10, "stretch must be above 1 and at most 10");
    require(config.threads >= 0 && config.threads <= 4096, "threads must be from 0 (all cores) to 4096");
}

UvSource parse_uv_source(const std::string& text, const std::string& source) {
    if (text == "unwrap") return UvSource::unwrap;
    if (text == "existing") return UvSource::existing;
    if (text == "auto") return UvSource::automatic;
    throw Error(ErrorKind::usage, source + ": uv must be unwrap, existing or auto, not \"" + text + "\"");
}

std::string name_of(UvSource uv) {
    switch (uv) {
        case UvSource::existing:
            return "existing";
        case UvSource::automatic:
            return "auto";
        default:
            return "unwrap";
    }
}

UvQuality parse_uv_quality(const std::string& text, const std::string& source) {
    for (const UvQuality quality : {UvQuality::draft, UvQuality::medium, UvQuality::high})
        if (text == name_of(quality)) return quality;
    throw Error(ErrorKind::usage, source + ": uv-quality must be draft, medium or high, not \"" + text + "\"");
}

std::string name_of(UvQuality quality) {
    switch (quality) {
        case UvQuality::draft:
            return "draft";
        case UvQuality::high:
            return "high";
        default:
            return "medium";
    }
}

std::string nearest(const std::string& word, const std::vector<std::string>& candidates) {
    const auto edits = [&](const std::string& other) {  // Levenshtein 1966
        std::vector<size_t> row(other.size() + 1);
        std::iota(row.begin(), row.end(), size_t{0});
        for (size_t i = 1; i <= word.size(); ++i) {
            size_t diagonal = row[0];
            row[0] = i;
            for (size_t j = 1; j <= other.size(); ++j) {
                const size_t substituted = diagonal + (word[i - 1] != other[j - 1]);
                diagonal = row[j];
                row[j] = std::min({row[j] + 1, row[j - 1] + 1, substituted});
            }
        }
        return row.back();
    };
    return *std::min_element(candidates.begin(), candidates.end(),
                             [&](const auto& a, const auto& b) { return edits(a) < edits(b); });
}

}  // namespace surimi
