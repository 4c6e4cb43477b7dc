// SPDX-License-Identifier: MIT
#include "geo/recorded_examples.h"

#include <algorithm>

namespace sigs::test {

const std::string kGpxExample = R"(<?xml version="1.0" encoding="UTF-8"?>
<gpx version="1.1" creator="hand" xmlns="http://www.topografix.com/GPX/1/1">
  <metadata><time>2020-01-01T00:00:00Z</time></metadata>
  <wpt lat="1" lon="2"><name>a place</name></wpt>
  <trk>
    <name>Flight &amp; home</name>
    <trkseg>
      <trkpt lat="47.1" lon="8.1"><ele>500.5</ele><time>2026-05-01T12:00:00Z</time></trkpt>
      <trkpt lat="47.11" lon="8.11"><ele>510</ele><time>2026-05-01T12:00:01.5Z</time></trkpt>
    </trkseg>
    <trkseg>
      <trkpt lat="47.12" lon="8.12"><ele>520</ele><time>2026-05-01T12:00:03Z</time></trkpt>
      <trkpt lat="47.13" lon="8.13"><ele>530</ele><time>2026-05-01T12:00:04Z</time></trkpt>
    </trkseg>
  </trk>
  <trk><name>second</name><trkseg>
    <trkpt lat="-33.9" lon="18.4"><ele>12</ele><time>2026-05-01T14:00:00+02:00</time></trkpt>
    <trkpt lat="-33.91" lon="18.41"><ele>13</ele><time>2026-05-01T14:00:05+02:00</time></trkpt>
  </trkseg></trk>
  <rte><name>plan</name><rtept lat="47" lon="8"/><rtept lat="47.5" lon="8.5"/><rtept lat="48" lon="9"/></rte>
</gpx>
)";

const std::string kKmlExample = R"(<?xml version="1.0" encoding="UTF-8"?>
<kml xmlns="http://www.opengis.net/kml/2.2" xmlns:gx="http://www.google.com/kml/ext/2.2">
<Document><name>all</name>
  <Placemark><name>track</name>
    <gx:Track><altitudeMode>absolute</altitudeMode>
      <when>2026-05-01T12:00:00Z</when><when>2026-05-01T12:00:01Z</when><when>2026-05-01T12:00:02Z</when>
      <gx:coord>8.1 47.1 500</gx:coord><gx:coord/><gx:coord>8.3   47.3
        520</gx:coord>
      <gx:angles>10 0 0</gx:angles>
    </gx:Track>
  </Placemark>
  <Placemark><name>two parts</name>
    <gx:MultiTrack><altitudeMode>relativeToGround</altitudeMode>
      <gx:Track><when>2026-05-01T12:00:00Z</when><gx:coord>8 47 10</gx:coord></gx:Track>
      <gx:Track><when>2026-05-01T12:00:09Z</when><gx:coord>8.1 47 20</gx:coord></gx:Track>
    </gx:MultiTrack>
  </Placemark>
  <Folder><name>inner</name>
    <Placemark><name>line</name><MultiGeometry><LineString><altitudeMode>absolute</altitudeMode><coordinates>
      8.0,47.0,400 8.1,47.1,410
      8.2,47.2,420</coordinates></LineString></MultiGeometry></Placemark>
    <Placemark><name>flat</name><LineString><coordinates>8.0,47.0 8.1,47.1</coordinates></LineString></Placemark>
    <Placemark><TimeStamp><when>2026-05-01T12:00:00Z</when></TimeStamp><Point><coordinates>7,46,100</coordinates>
      </Point></Placemark>
    <Placemark><TimeStamp><when>2026-05-01T12:00:04Z</when></TimeStamp><Point><coordinates>7.1,46.1,140</coordinates>
      </Point></Placemark>
    <Placemark><name>a place alone</name><Point><coordinates>7.1,46.1,140</coordinates></Point></Placemark>
  </Folder>
</Document></kml>
)";

const std::string kAircraftExample = R"({"now": 1777636800.0, "messages": 12345, "aircraft": [
 {"hex":"3C6444","flight":"DLH400  ","alt_baro":10000,"alt_geom":10500,"gs":400.1,"lat":47.5,"lon":8.5,"seen_pos":0.4,"seen":0.1},
 {"hex":"4b1814","alt_baro":"ground","lat":47.45,"lon":8.55,"seen_pos":3.0},
 {"hex":"~2a1b3c","alt_baro":2000,"lat":47.6,"lon":8.6},
 {"hex":"abcdef","seen":1.0}
]})";

const std::string kTraceExample = R"({"icao":"3c6444","r":"D-ABCD","t":"A320","timestamp":1777636800.5,"trace":[
 [0.0,47.50,8.50,10000,400.1,90.0,0,640,{"type":"adsb_icao","flight":"DLH400  ","alt_geom":10500},"adsb_icao",10500,640,280,1.5],
 [4.0,47.50,8.51,10050,400.1,90.0,0,640,null,"adsb_icao",null,null,null,null],
 [8.0,47.50,8.52,10100,400.1,90.0,0,640,null,"adsb_icao",10620,null,null,null],
 [100.0,47.50,8.70,11000,400.1,90.0,9,640,null],
 [104.0,47.50,8.71,"ground",0,90.0,0,null,null,"adsb_icao",null]
]})";

const std::string kStatesExample = R"({"time":1777636805,"states":[
 ["3c6444","DLH400  ","Germany",1777636800,1777636804,8.5,47.5,3048,false,205.8,90.0,3.3,null,3200.4,"1000",false,0],
 ["4b1814",null,"Switzerland",1777636801,1777636804,8.55,47.45,1000.5,false,50,10,0,null,null,null,false,0],
 ["400000","NOPOS   ","United Kingdom",null,1777636804,null,null,null,false,null,null,null,null,null,null,false,0]
]})";

const std::string kTrackExample =
    R"({"icao24":"3c6444","startTime":1777636800,"endTime":1777636860,"callsign":"DLH400  ",
 "path":[[1777636800,47.5,8.5,3048,90,false],[1777636820,47.5,8.55,3100,90,false],[1777636860,47.5,8.65,3200,92,false]]})";

const std::string kOpenskyCsvExample =
    "time,icao24,lat,lon,velocity,heading,vertrate,callsign,onground,alert,spi,squawk,baroaltitude,geoaltitude,"
    "lastposupdate,lastcontact\n"
    "1777636800,3c6444,47.5,8.5,205.8,90,3.3,DLH400  ,False,False,False,1000,3048.0,3200.4,1777636799.5,1777636799.9\n"
    "1777636801,3c6444,47.5,8.5,205.8,90,3.3,DLH400  ,False,False,False,1000,3048.0,3200.4,1777636799.5,1777636800.9\n"
    "1777636801,4b1814,,,,,,,False,False,False,,,,,1777636800.9\n"
    "1777636802,3c6444,47.5,8.505,205.8,90,3.3,DLH400  "
    ",False,False,False,1000,3051.0,3203.4,1777636801.5,1777636801.9\n"
    "1777636802,4b1814,47.45,8.55,50,10,0,,False,False,False,,1000.5,,1777636801.9,1777636801.9\n";

std::string gpx_of(const std::string& points) {
  return "<gpx version='1.1'><trk><trkseg>" + points + "</trkseg></trk></gpx>";
}

bool has_warning(const RecordedPath& path, const std::string& part) {
  return std::any_of(path.warnings.begin(), path.warnings.end(),
                     [&](const Warning& warning) { return warning.text().find(part) != std::string::npos; });
}

}  // namespace sigs::test
