/* Cyclone's `ddsi_endpoint_match.c` with two changes. The sources stay as published: both changes are
   macros over names that the file uses.

   A matched reader gets a filter, which Cyclone asks before it retransmits a sample to that reader. A
   sample with a destination (see transmit.c) is retransmitted to its destination only; other readers get
   a GAP. The filter is set at the point where DDS Security, which is not built in, would be asked.

   A reader asks writers of Fast DDS for all samples since the match, not only writers of Cyclone DDS.
   The peer that discovers first also writes first. What it sends before this side knows its writer is
   dropped, and Cyclone lets a volatile reader of another vendor's writer begin with the newest sample,
   so the dropped ones were never requested again. Fast DDS, like Cyclone, holds back what is older than
   the match (`ReaderProxy` there: a volatile reader gets GAPs for it). Only this change depends on the
   vendor. */
#include <stdbool.h>

#include "ddsi__vendor.h"

#include "ddsi__security_omg.h"

struct ddsi_writer;
struct ddsi_proxy_reader;
bool pp_set_filter(const struct ddsi_writer *writer, struct ddsi_proxy_reader *reader);

#define ddsi_omg_security_match_remote_reader_enabled(writer, reader, relay, handle) \
  (pp_set_filter((writer), (reader)) &&                                              \
   ddsi_omg_security_match_remote_reader_enabled((writer), (reader), (relay), (handle)))
#define ddsi_vendor_is_eclipse(vendor) (ddsi_vendor_is_eclipse (vendor) || ddsi_vendor_is_eprosima (vendor))
#include "ddsi_endpoint_match.c"
