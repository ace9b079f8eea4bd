# SPDX-License-Identifier: GPL-3.0-or-later
# klayout -b -r run_rules.rb -rd jobs=JOBS.json: of each {"script", "gds", "result"} what the DRC script finds, written to its result,
# {"categories": {NAME: [[[x, y], ...], ...]}, "s": SECONDS}, in nm
require "json"
$every = true # every pair of edges, not the worst of each place
JSON.parse(File.read($jobs)).each do |job|
  $input, $report = job["gds"], job["gds"] + ".lyrdb"
  start = Time.now
  RBA::Macro::new(job["script"]).run
  found = {}
  db = RBA::ReportDatabase::new("")
  db.load($report)
  points = lambda { |list| list.map { |p| [(1000 * p.x).round, (1000 * p.y).round] } }
  db.each_item do |item|
    item.each_value do |v|
      shape = if v.is_polygon? then points.call(v.polygon.each_point_hull.to_a)
              elsif v.is_box? then points.call([v.box.p1, v.box.p2])
              elsif v.is_edge? then points.call([v.edge.p1, v.edge.p2])
              elsif v.is_edge_pair? then points.call([v.edge_pair.first.p1, v.edge_pair.first.p2, v.edge_pair.second.p1, v.edge_pair.second.p2])
              end
      (found[db.category_by_id(item.category_id).name] ||= []) << shape if shape
    end
  end
  File.delete($report)
  File.write(job["result"], JSON.generate({"categories" => found, "s" => Time.now - start}))
end
