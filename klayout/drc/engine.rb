# What the rules do. Edges of KLayout have the material on their right; all numbers are whole nanometres (the grid of masks).

module FlexwrightRules
  GRID = Math.sqrt(2.0) # what rounding both ends of an edge to the grid moves them, at most, against each other
  SQUARE_RAD = Math::PI / 2
  SAME_RAD = 0.2 * Math::PI / 180 # tangents of arcs that are taken from their chords
  AT_CORNERS_RAD = 7.5 * Math::PI / 180
  CORNER_RAD = 20.0 * Math::PI / 180 # chords of arcs turn less from one to the next

  def self.left(e, x, y)
    (e.x2 - e.x1) * (y - e.y1) - (e.y2 - e.y1) * (x - e.x1)
  end

  # of a point from the segment a b
  def self.off(ax, ay, bx, by, x, y)
    dx, dy, ux, uy = bx - ax, by - ay, x - ax, y - ay
    square = (dx * dx + dy * dy).to_f
    t = square > 0 ? [[(ux * dx + uy * dy) / square, 0.0].max, 1.0].min : 0.0
    Math.hypot(ux - t * dx, uy - t * dy)
  end

  def self.apart(p, q)
    [off(*p, q[0], q[1]), off(*p, q[2], q[3]), off(*q, p[0], p[1]), off(*q, p[2], p[3])].min
  end

  # what of e lies on that side of f
  def self.cut(e, f, sign)
    a, b = sign * left(f, e.x1, e.y1), sign * left(f, e.x2, e.y2)
    return [e.x1, e.y1, e.x2, e.y2] if a >= 0 && b >= 0
    t = a / (a - b).to_f
    x, y = e.x1 + t * (e.x2 - e.x1), e.y1 + t * (e.y2 - e.y1)
    a < 0 ? [x, y, e.x2, e.y2] : [e.x1, e.y1, x, y]
  end

  # The value of a width or space, as docs/theory/masks.md has it: the greater of the least distances from the part of
  # one edge on the other's side to the other one, and back. KLayout rounds those of parallel edges.
  def self.value(e, f, sign)
    p, q = [e.x1, e.y1, e.x2, e.y2], [f.x1, f.y1, f.x2, f.y2]
    [apart(cut(e, f, sign), q), apart(p, cut(f, e, sign))].max
  end

  def self.turn(a, b) # from edge to edge, left positive
    Math.atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1])
  end

  # Contours of a merged region, with the turn at each vertex and what the drawing turns there: an arc is written as equal
  # chords, so that its tangent at an end is half the turn of the next vertex off the first chord.
  class Contours
    attr_reader :all

    def initialize(region)
      @all = []
      @at = {}
      region.each_merged do |polygon|
        add(polygon.each_point_hull.to_a)
        polygon.holes.times { |k| add(polygon.each_point_hole(k).to_a) }
      end
    end

    def add(points)
      n = points.size
      along = (0...n).map { |i| p, q = points[i], points[(i + 1) % n]; [q.x - p.x, q.y - p.y] }
      turn = (0...n).map { |i| FlexwrightRules.turn(along[i - 1], along[i]) } # at point i, where edge i begins
      drawn = (0...n).map do |i|
        half = [turn[i - 1], turn[(i + 1) % n]].map { |t| t.abs < CORNER_RAD ? t / 2 : 0 }
        next turn[i] if turn[i].abs < CORNER_RAD
        # whether a side is an arc or a line before one cannot be seen: the bluntest corner that it can be
        [0, half[0], half[1], half[0] + half[1]].map { |h| turn[i] - h }.min_by { |t| t.abs }
      end
      @all << [points, along, turn, drawn]
      n.times { |i| @at[[points[i].x, points[i].y, points[(i + 1) % n].x, points[(i + 1) % n].y]] = [@all.size - 1, i] }
    end

    # do two edges near each other meet at a corner of the drawing that is square or blunter?
    def around_blunt_corner(e, f, reach)
      a, b = @at[[e.x1, e.y1, e.x2, e.y2]], @at[[f.x1, f.y1, f.x2, f.y2]]
      return false unless a && b && a[0] == b[0]
      points, along, turn, drawn = @all[a[0]]
      [[a[1], b[1]], [b[1], a[1]]].any? { |from, to| blunt(points.size, along, turn, drawn, from, to, reach) }
    end

    # is this edge a chord of an arc, and no line? Those of one arc are equal.
    def chord(edge)
      at = @at[[edge.x1, edge.y1, edge.x2, edge.y2]]
      return true unless at
      _, along, turn, = @all[at[0]]
      i, n = at[1], along.size
      own = Math.hypot(*along[i])
      [[i - 1, turn[i]], [(i + 1) % n, turn[(i + 1) % n]]].any? do |k, t|
        t.abs < CORNER_RAD && (Math.hypot(*along[k]) - own).abs < 2 * GRID
      end
    end

    # two lines at a square angle, whatever the grid made of it: the drawing's do not face each other
    def square_lines(e, f)
      dot = (e.dx * f.dx + e.dy * f.dy) / (e.length.to_f * f.length)
      dot > -(GRID / e.length + GRID / f.length) && !chord(e) && !chord(f)
    end

    def blunt(n, along, turn, drawn, from, to, reach)
      length, corner, i = 0.0, nil, from
      while i != to
        i = (i + 1) % n
        if turn[i].abs >= CORNER_RAD
          return false if corner
          corner = drawn[i]
        end
        length += Math.hypot(*along[i]) unless i == to
        return false if length > reach
      end
      !corner.nil? && corner.abs <= SQUARE_RAD + [SAME_RAD, GRID / Math.hypot(*along[from]) + GRID / Math.hypot(*along[to])].max
    end
  end

  # pairs of edges whose width or space is below the limit, with their values
  def self.pairs(found, contours, sign, limit)
    out = []
    found.each do |pair|
      e, f = pair.first, pair.second
      v = value(e, f, sign)
      next unless v < limit - 1e-6
      dot = (e.dx * f.dx + e.dy * f.dy) / (e.length.to_f * f.length)
      next if dot > -Math.sin(AT_CORNERS_RAD) - 1e-12 && (contours.square_lines(e, f) || contours.around_blunt_corner(e, f, 4 * limit))
      out << [pair, v]
    end
    out
  end

  # The worst pair of each place: pairs whose edges run into each other are one. All of them where $every is set.
  def self.places(found)
    place, first = (0...found.size).to_a, {}
    root = lambda do |i|
      i = place[i] = place[place[i]] while place[i] != i
      i
    end
    found.each_with_index do |(pair, _), i|
      [pair.first, pair.second].each do |e|
        [[e.x1, e.y1], [e.x2, e.y2]].each do |at|
          first[at] ? place[root.call(i)] = root.call(first[at]) : first[at] = i
        end
      end
    end
    worst = {}
    found.each_with_index do |(_, v), i|
      g = $every ? i : root.call(i)
      worst[g] = i if worst[g].nil? || v < found[worst[g]][1]
    end
    out = RBA::EdgePairs::new
    worst.values.each { |i| out.insert(found[i][0]) }
    out
  end

  def self.chords(region, contours, kind, limit)
    reach = limit.ceil + 2
    options = [reach, true, RBA::Region::Euclidian, 90.0, nil, nil, false]
    found = case kind
            when "width" then region.width_check(*options)
            when "space" then region.space_check(*options)
            when "isolated" then region.isolated_check(*options)
            when "notch" then region.notch_check(*options)
            end
    places(pairs(found, contours, kind == "width" ? -1 : 1, limit))
  end

  def self.corners(contours, limit, drawn)
    out = RBA::Edges::new
    contours.all.each do |points, along, turn, as_drawn|
      n = points.size
      n.times do |i|
        slack = drawn ? [SAME_RAD, GRID / Math.hypot(*along[i - 1]) + GRID / Math.hypot(*along[i])].max : 1e-12
        next unless Math::PI - (drawn ? as_drawn[i] : turn[i]).abs < limit - slack
        out.insert(RBA::Edge::new(points[i].x, points[i].y, points[i].x, points[i].y))
      end
    end
    out
  end

  # distances of the written edges of two layers, whatever way they face
  def self.between(inner, outer, limit)
    out = []
    reach = limit.ceil + 1
    edges = RBA::Shapes::new # found by their boxes
    edges.insert(outer.edges)
    inner.edges.each do |e|
      p = [e.x1, e.y1, e.x2, e.y2]
      edges.each_touching(e.bbox.enlarged(reach, reach)) do |shape|
        f = shape.edge
        v = apart(p, [f.x1, f.y1, f.x2, f.y2])
        out << [RBA::EdgePair::new(e, f), v] if v < limit - 1e-6
      end
    end
    places(out)
  end

  # windows of a side, by a step, of which the last ones end at the end; those out of bounds, as one where they meet but with $every
  def self.windows(region, all, least, most, side, step)
    out = RBA::Region::new
    return out if all.empty?
    step = [step, [all.width, all.height].max / 1000.0].max
    wide, high = [side, all.width].min, [side, all.height].min
    starts = lambda do |from, to|
      n = to - from <= side ? 1 : 1 + ((to - from - side) / step.to_f - 1e-9).ceil
      (0...n).map { |i| [from, [from + i * step, to - side].min].max }
    end
    starts.call(all.bottom, all.top).each do |y|
      band = region & RBA::Region::new(RBA::Box::new(all.left, y.round, all.right, (y + high).round)) # a row of windows
      starts.call(all.left, all.right).each do |x|
        window = RBA::Box::new(x.round, y.round, (x + wide).round, (y + high).round)
        share = band.area(window) / window.area.to_f
        out.insert(window) if share < least * (1 - 1e-9) || share > most * (1 + 1e-9)
      end
    end
    $every ? out.merged_semantics = false : out.merge
    out
  end
end

# One rule of the table. Numbers: nm, rad, nm2 or a share; more[:name] is the category of what it finds.
def flexwright_rule(kind, layer, least, more = {})
  numbers = lambda { |text| text.split("/").map { |n| n.to_i } }
  raw = input(*numbers.call(layer))
  @fw_merged ||= {}
  @fw_contours ||= {}
  merged = @fw_merged[layer] ||= raw.merged.data
  contours = lambda { @fw_contours[layer] ||= FlexwrightRules::Contours::new(merged) }
  other = more[:other] && (@fw_merged[more[:other]] ||= input(*numbers.call(more[:other])).merged.data)
  tell = lambda do |data, what = nil|
    name = what ? more[:name] + ", " + what : more[:name]
    DRC::DRCLayer::new(self, data).output(name, more[:source]) unless data.is_empty?
  end
  case kind
  when "width", "notch"
    tell.call(FlexwrightRules.chords(merged, contours.call, kind, least))
  when "space"
    tell.call(FlexwrightRules.chords(merged, contours.call, more[:notch] ? "isolated" : "space", least))
  when "feature"
    %w[width space].each { |k| tell.call(FlexwrightRules.chords(merged, contours.call, k, least), k) }
  when "angle"
    tell.call(FlexwrightRules.corners(contours.call, least, more[:of] == "outline"))
  when "edge"
    if more[:of] == "polygon" # KLayout's own lengths are rounded to the grid, so that 0.6995 um would be 0.7
      short = RBA::Edges::new
      short.merged_semantics = false
      raw.raw.edges.data.with_length(0, least.ceil + 1, false).each { |e| short.insert(e) if e.sq_length < least * least }
      tell.call(short)
    end
  when "area"
    tell.call(merged.with_area(0, least.ceil, false), "island") if more[:of].nil? || more[:of] == "island"
    tell.call(merged.holes.with_area(0, least.ceil, false), "hole") if more[:of].nil? || more[:of] == "hole"
  when "density"
    all = RBA::Box::new
    more[:layers].each { |l| all += (@fw_merged[l] ||= input(*numbers.call(l)).merged.data).bbox }
    tell.call(FlexwrightRules.windows(merged, all, least, more[:most], more[:window], more[:step]))
  when "enclosure"
    tell.call(merged.not_inside(other), "outside")
    tell.call(FlexwrightRules.between(merged.inside(other), other, least), "too near")
  when "separation"
    tell.call(merged.interacting(other), "meet")
    tell.call(FlexwrightRules.between(merged.not_interacting(other), other, least), "too near")
  when "overlap"
    tell.call(RBA::Region::new(raw.raw.data.each.to_a).merged(2))
  end
end
