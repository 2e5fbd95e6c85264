// lacuna-analyse RECORDING.csv --settings FILE [--out FILE.json] [--spectrum FILE.csv]
//
// Features of one recording as JSON, on standard output or in a file (the mean speed is null without the angle); with
// --spectrum also the peak-hold amplitude spectra as CSV. Exit code 1 and one line on standard error where the
// recording or the settings cannot be used.
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>

#include "lacuna/chain.hpp"
#include "lacuna/error.hpp"
#include "lacuna/recording.hpp"

namespace {

using lacuna::Error;

constexpr const char *usage =
    "usage: lacuna-analyse RECORDING.csv --settings FILE [--out FILE.json] [--spectrum FILE.csv]";

struct Arguments {
  std::string recording, settings, out, spectrum;
};

Arguments parse(int argc, char **argv) {
  Arguments arguments;
  for (int k = 1; k < argc; ++k) {
    const std::string word = argv[k];
    std::string *target = word == "--settings"   ? &arguments.settings
                          : word == "--out"      ? &arguments.out
                          : word == "--spectrum" ? &arguments.spectrum
                                                 : &arguments.recording;
    if (target != &arguments.recording && ++k == argc) throw Error(word + " needs a file name\n" + usage);
    if (!target->empty() || (target == &arguments.recording && word.starts_with("--")))
      throw Error("unexpected argument " + word + "\n" + usage);
    *target = argv[k];
  }
  if (arguments.recording.empty() || arguments.settings.empty()) throw Error(usage);
  return arguments;
}

std::ifstream open(const std::string &path) {
  std::ifstream file(path);
  if (!file) throw Error("cannot read " + path);
  return file;
}

std::string contents(const std::string &path) {
  std::ostringstream text;
  text << open(path).rdbuf();
  return text.str();
}

/// The shortest text that reads back as the same number; null, as JSON has no NaN.
std::string json(double x) {
  if (!std::isfinite(x)) return "null";
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, x).ptr};
}

std::string quoted(const std::string &text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

std::string features_json(const lacuna::Chain &chain, const lacuna::Features &features) {
  std::ostringstream out;
  out << "{\n  \"rms_mean\": " << json(features.rms_mean) << ",\n  \"speed_mean\": " << json(features.speed.value)
      << ",\n  \"turns\": " << features.speed.turns << ",\n  \"resolution_hz\": " << json(chain.resolution_hz())
      << ",\n  \"channels\": [";
  for (std::size_t c = 0; c < features.channels.size(); ++c) {
    const lacuna::ChannelFeatures &channel = features.channels[c];
    out << (c ? ",\n" : "\n") << "    {\"signal\": " << quoted(chain.settings().currents[c])
        << ", \"rms\": " << json(channel.rms) << ", \"peak_hz\": " << json(channel.peak_hz)
        << ", \"peak_bin\": " << (channel.peak_bin < 0 ? "null" : std::to_string(channel.peak_bin))
        << ", \"peak_amplitude\": " << json(channel.peak_amplitude) << ", \"frequency\": " << json(channel.frequency)
        << ", \"harmonics\": [";
    for (std::size_t h = 0; h < channel.harmonic.size(); ++h)
      out << (h ? ", " : "") << json(channel.harmonic[h]);
    out << "]}";
  }
  out << "\n  ]\n}\n";
  return out.str();
}

std::string spectrum_csv(const lacuna::Chain &chain, const lacuna::Features &features) {
  std::ostringstream out;
  out << "frequency";
  for (const std::string &name : chain.settings().currents)
    out << ',' << quoted(name);
  for (std::size_t k = 0; k < chain.spectrum().lines(); ++k) {
    out << '\n' << json(static_cast<double>(k) * chain.resolution_hz());
    for (const Eigen::ArrayXd &held : features.held)
      out << ',' << json(held[static_cast<Eigen::Index>(k)]);
  }
  out << '\n';
  return out.str();
}

/// Complete or not at all: written beside its place and renamed.
void write_file(const std::string &path, const std::string &text) {
  const std::string partial = path + ".partial";
  std::ofstream file(partial, std::ios::binary);
  file << text;
  file.close();
  if (!file || std::rename(partial.c_str(), path.c_str()) != 0) {
    std::remove(partial.c_str());
    throw Error("cannot write " + path);
  }
}

void run(const Arguments &arguments) {
  const lacuna::Chain chain(lacuna::Settings::parse(contents(arguments.settings)));
  const lacuna::Settings &settings = chain.settings();
  std::ifstream csv = open(arguments.recording);
  const auto recording =
      lacuna::Recording::read(csv, settings.currents, settings.angle, settings.sampling_rate, settings.samples());
  std::vector<std::span<const double>> currents;
  for (std::size_t c = 0; c < settings.currents.size(); ++c)
    currents.push_back(recording.column(c));
  const lacuna::Features features = chain.analyse(currents, recording.optional());
  if (!arguments.spectrum.empty()) write_file(arguments.spectrum, spectrum_csv(chain, features));
  if (arguments.out.empty())
    std::cout << features_json(chain, features);
  else
    write_file(arguments.out, features_json(chain, features));
}

} // namespace

int main(int argc, char **argv) {
  try {
    run(parse(argc, argv));
    return 0;
  } catch (const std::exception &error) {
    std::cerr << "lacuna-analyse: " << error.what() << '\n';
    return 1;
  }
}
