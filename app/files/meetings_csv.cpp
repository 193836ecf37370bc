#include "app/files/meetings_csv.h"

#include "app/files/csv_line.h"

namespace app::files {

using collide::oracle::FeatureMeeting;

MeetingsCsv::MeetingsCsv(const std::filesystem::path& path)
    : file_(path, "kind,a0,a1,b0,b1,b2,time_low,time_high,passes\n") {}

void MeetingsCsv::add(const FeatureMeeting& meeting) {
  const auto& [a0, a1] = meeting.feature;
  const auto& [b0, b1, b2] = meeting.against;
  CsvLine line;
  if (meeting.kind == FeatureMeeting::Kind::vertex_face) {
    line.add_text("vf", ',');
    line.add(a0, ',');
    line.add_text("", ',');
    line.add(b0, ',');
    line.add(b1, ',');
    line.add(b2, ',');
  } else {
    line.add_text("ee", ',');
    line.add(a0, ',');
    line.add(a1, ',');
    line.add(b0, ',');
    line.add(b1, ',');
    line.add_text("", ',');
  }
  line.add(meeting.first.low, ',');
  line.add(meeting.first.high, ',');
  line.add(int{meeting.passes}, '\n');
  file_.write(line.text());
}

}  // namespace app::files
