/* SPDX-License-Identifier: GPL-3.0-or-later */
/* geos_check.c: independent GEOS proof of polygon quality straight from a GDSII file (flat BOUNDARY records of one layer, 1 cell level).
   Prints polygons, vertices, invalid count, smallest GEOS minimum clearance (the smallest vertex move that would break the polygon; = sliver measure), area.
   gcc -O2 geos_check.c -lgeos_c -lm -o geos_check ; usage: geos_check FILE.gds layer datatype min_clearance_um ; exit 1 when invalid or clearance below */
#include <geos_c.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <stdint.h>
#include <stdarg.h>
#include <math.h>
#include <time.h>
static double cpu(void){struct timespec t;clock_gettime(CLOCK_PROCESS_CPUTIME_ID,&t);return t.tv_sec+1e-9*t.tv_nsec;}
static void note(const char*f,...){va_list a;va_start(a,f);vfprintf(stderr,f,a);fputc('\n',stderr);va_end(a);}
static int be16(const uint8_t*p){return p[0]<<8|p[1];}
static int32_t be32(const uint8_t*p){return (int32_t)((uint32_t)p[0]<<24|p[1]<<16|p[2]<<8|p[3]);}
static double r8(const uint8_t*p){double m=0;for(int i=1;i<8;i++)m=m*256+p[i];return (p[0]&128?-1:1)*ldexp(m,4*((p[0]&127)-64)-56);}
int main(int c,char**v){
  if(c<5)return 2;FILE*f=fopen(v[1],"rb");if(!f)return 2;fseek(f,0,2);long n=ftell(f);rewind(f);uint8_t*b=malloc(n+8);if(fread(b,1,n,f)!=(size_t)n)return 2;fclose(f);
  int L=atoi(v[2]),D=atoi(v[3]);double minc=atof(v[4]),dbu=1e-3;GEOSContextHandle_t h=GEOS_init_r();GEOSContext_setNoticeHandler_r(h,note);GEOSContext_setErrorHandler_r(h,note);
  long np=0,nv=0,bad=0;double area=0,clr=INFINITY,t0=cpu();int inb=0,lay=-1,dt=-1;
  for(long p=0;p+4<=n;){int len=be16(b+p),ty=b[p+2];if(len<4)break;const uint8_t*d=b+p+4;
    if(ty==3)dbu=r8(d+8)*1e6;else if(ty==8){inb=1;lay=dt=-1;}else if(ty==0x0d)lay=be16(d);else if(ty==0x0e)dt=be16(d);else if(ty==0x11)inb=0;
    else if(ty==0x10&&inb&&lay==L&&dt==D){int k=(len-4)/8;double*q=malloc(sizeof*q*2*k);for(int i=0;i<2*k;i++)q[i]=be32(d+4*i)*dbu;
      GEOSCoordSequence*s=GEOSCoordSeq_copyFromBuffer_r(h,q,k,0,0);GEOSGeometry*ring=GEOSGeom_createLinearRing_r(h,s);free(q);np++;nv+=k-1;
      if(!ring){bad++;}else{GEOSGeometry*g=GEOSGeom_createPolygon_r(h,ring,NULL,0);if(GEOSisValid_r(h,g)!=1)bad++;double a,m;GEOSArea_r(h,g,&a);area+=a;if(GEOSMinimumClearance_r(h,g,&m)==0&&m<clr)clr=m;GEOSGeom_destroy_r(h,g);}}
    p+=len;if(ty==4)break;}
  int fail=bad||clr<minc;printf("%s layer %d/%d polygons %ld vertices %ld invalid %ld minimum clearance %.6f um area %.6f um2 cpu %.3f s => %s\n",v[1],L,D,np,nv,bad,clr,area,cpu()-t0,fail?"FAIL":"PASS");return fail;}
