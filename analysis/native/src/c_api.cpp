#include "lacuna_analysis.h"

#include <algorithm>
#include <cstring>
#include <exception>

#include "lacuna/chain.hpp"
#include "lacuna/severity_table.hpp"
#include "lacuna/signature.hpp"
#include "lacuna/transform.hpp"

struct lacuna_table {
  lacuna::SeverityTable table;
};

struct lacuna_chain {
  lacuna::Chain chain;
};

namespace {

void write(const char *text, char *message, size_t size) {
  if (!message || size == 0) return;
  const size_t n = std::min(size - 1, std::strlen(text));
  std::memcpy(message, text, n);
  message[n] = '\0';
}

/// Runs `action`, turning an exception, which must not cross into C, into a message and a failure.
template <typename Action> int guarded(char *message, size_t size, Action action) {
  try {
    action();
    return 0;
  } catch (const std::exception &error) {
    write(error.what(), message, size);
    return -1;
  }
}

std::vector<lacuna::ChannelFeatures> channels_of(const lacuna_channel *channels, size_t count) {
  std::vector<lacuna::ChannelFeatures> result;
  for (const lacuna_channel &c : std::span(channels, count))
    result.push_back({c.rms,
                      static_cast<std::ptrdiff_t>(c.peak_bin),
                      c.peak_hz,
                      c.peak_amplitude,
                      c.frequency,
                      {c.harmonic[0], c.harmonic[1], c.harmonic[2], c.harmonic[3]}});
  return result;
}

lacuna::Settings settings_of(const lacuna_settings &s) {
  return {s.sampling_rate,
          s.duration,
          {s.currents, s.currents + s.channels},
          s.angle,
          s.section,
          s.overlap,
          static_cast<lacuna::Settings::Padding>(s.padding),
          s.peak_above,
          s.peak_threshold,
          s.speed_after};
}

} // namespace

lacuna_chain *lacuna_chain_new(const lacuna_settings *settings, char *message, size_t message_size) {
  lacuna_chain *chain = nullptr;
  guarded(message, message_size, [&] { chain = new lacuna_chain{lacuna::Chain(settings_of(*settings))}; });
  return chain;
}

void lacuna_chain_free(lacuna_chain *chain) {
  delete chain;
}

size_t lacuna_chain_channels(const lacuna_chain *chain) {
  return chain->chain.settings().currents.size();
}
size_t lacuna_chain_samples(const lacuna_chain *chain) {
  return chain->chain.settings().samples();
}
size_t lacuna_chain_sections(const lacuna_chain *chain) {
  return chain->chain.sections().count();
}
size_t lacuna_chain_section_length(const lacuna_chain *chain) {
  return chain->chain.sections().length();
}
size_t lacuna_chain_section_start(const lacuna_chain *chain, size_t section) {
  return chain->chain.sections().start(section);
}
size_t lacuna_chain_lines(const lacuna_chain *chain) {
  return chain->chain.spectrum().lines();
}
double lacuna_chain_resolution(const lacuna_chain *chain) {
  return chain->chain.resolution_hz();
}

int lacuna_chain_analyse(const lacuna_chain *chain, const double *const *currents, const double *angle, size_t samples,
                         lacuna_channel *channels, lacuna_summary *summary, double *held, char *message,
                         size_t message_size) {
  return guarded(message, message_size, [&] {
    std::vector<std::span<const double>> records;
    for (size_t c = 0; c < lacuna_chain_channels(chain); ++c)
      records.emplace_back(currents[c], samples);
    const std::span<const double> turned(angle, angle ? samples : 0);
    const lacuna::Features features = chain->chain.analyse(records, turned);
    for (const lacuna::ChannelFeatures &found : features.channels) {
      const auto &h = found.harmonic;
      *channels++ = {found.rms,      found.peak_hz,   found.peak_amplitude,
                     found.peak_bin, found.frequency, {h[0], h[1], h[2], h[3]}};
    }
    if (held)
      for (const Eigen::ArrayXd &spectrum : features.held)
        held = std::copy(spectrum.begin(), spectrum.end(), held);
    *summary = {features.rms_mean, features.speed.value, features.speed.turns};
  });
}

int lacuna_chain_section_spectrum(const lacuna_chain *chain, const double *section, double *amplitude, double *power,
                                  char *message, size_t message_size) {
  return guarded(message, message_size, [&] {
    const lacuna::SectionSpectrum &spectrum = chain->chain.spectrum();
    lacuna::RealTransform::Buffers work = spectrum.buffers();
    Eigen::ArrayXd squared;
    spectrum.squared_magnitude({section, spectrum.window().length()}, work, squared);
    const Eigen::ArrayXd a = spectrum.amplitude(squared), p = spectrum.power(squared);
    std::copy(a.begin(), a.end(), amplitude);
    std::copy(p.begin(), p.end(), power);
  });
}

size_t lacuna_signature_size(size_t channels) {
  return lacuna::signature_size(channels);
}

int lacuna_signature(const lacuna_channel *channels, size_t count, double *signature) {
  const auto features = channels_of(channels, count);
  return lacuna::signature(features, {signature, lacuna::signature_size(count)}) ? 0 : -1;
}

lacuna_table *lacuna_table_new(const void *bytes, size_t size, char *message, size_t message_size) {
  lacuna_table *table = nullptr;
  guarded(message, message_size, [&] {
    table = new lacuna_table{lacuna::SeverityTable({static_cast<const std::byte *>(bytes), size})};
  });
  return table;
}

void lacuna_table_free(lacuna_table *table) {
  delete table;
}

size_t lacuna_table_channels(const lacuna_table *table) {
  return table->table.configuration().channels;
}

int lacuna_table_estimate(const lacuna_table *table, const lacuna_channel *channels, double rms_mean,
                          lacuna_estimate *estimate) {
  const size_t count = lacuna_table_channels(table);
  std::vector<double> signature(lacuna::signature_size(count));
  if (lacuna_signature(channels, count, signature.data()) != 0) return -1;
  const lacuna::Estimate e = table->table.estimate(signature, rms_mean);
  *estimate = {e.severity, e.low, e.high, e.misfit, e.paper, static_cast<int>(e.band), e.covered ? 1 : 0};
  return 0;
}

const char *lacuna_transform_name(void) {
  return lacuna::RealTransform::implementation();
}
